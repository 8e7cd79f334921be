// Returns a vector turned by a quaternion (x, y, z, w from `at` on, with any scale).
export function rotate([x, y, z], q, at = 0) {
  const [qx, qy, qz, qw] = [q[at], q[at + 1], q[at + 2], q[at + 3]];
  const [tx, ty, tz] = [2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)];
  return [x + qw * tx + qy * tz - qz * ty, y + qw * ty + qz * tx - qx * tz, z + qw * tz + qx * ty - qy * tx];
}
