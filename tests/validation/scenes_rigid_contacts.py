"""Contacts of dynamics3d: collisions at all phases of a step, slopes, slippery floors, terrain, and sensors of robots that lean."""
import math
import struct
import zlib

from experiment import block, element, footbot, prey, probe
from report import Row, scene
from scenes_dynamics2d import COLLISION, COULOMB, G
from scenes_dynamics3d import GROUP, on_incline

STATICS = "statics"
WHEEL = 0.029112741
CENTRE, CASTER = 0.0448, 0.075  # m, height of a footbot's centre of mass, and from its middle to a caster


def collide(lab, shape, step_ms, restitution, offset, phases):
    """In lanes a robot pushes a body of 0.5 kg, which meets one of 0.8 kg. The lanes differ by parts of a step's way. Returns
    the largest error of the energy after the collision and the largest height."""
    speed, push = 0.3, 0.5
    ticks = round(2200 / step_ms)
    stop = round(1000 * push / step_ms)
    who = probe("c", [(0, stop, "footbot_wheels", speed, speed), (stop + 1, ticks, "footbot_wheels", -0.1, -0.1)])
    more = {"friction": 0, "ground_friction": 0}
    arena = ""
    for lane in range(phases):
        y = 1.0 + lane
        # Lanes are a whole number of steps and a part of one apart.
        x = 2.75 + speed * step_ms / 1000 * (lane / phases + lane % 7)
        arena += footbot(f"r{lane}", 2.0, y, 0, "c")
        if shape == "cube":
            arena += block(f"a{lane}", f"2.186,{y!r},0.1", "0.2,0.2,0.2", movable="true", mass=0.5, restitution=0, **more)
            arena += block(f"b{lane}", f"{x!r},{y + offset!r},0.1", "0.2,0.2,0.2", movable="true", mass=0.8, restitution=restitution, **more)
        else:
            arena += prey(f"a{lane}", 2.186, y, radius=0.1, height=0.1, mass=0.5, restitution=0, **more)
            arena += prey(f"b{lane}", x, y + offset, radius=0.1, height=0.1, mass=0.8, restitution=restitution, **more)
    every = round(50 / step_ms)
    result = lab.run(arena, who, "dynamics3d", ticks, step_ms, size=f"10,{phases + 2},3", every=every, friction=0, step_ms=step_ms)
    worst, highest = 0, 0
    rest = 0.1 if shape == "cube" else 0
    for lane in range(phases):
        a, b = result.track(f"a{lane}"), result.track(f"b{lane}")
        hit = next(i for i, p in enumerate(b) if abs(p[0] - b[0][0]) > 1e-6)
        energy = lambda i: 0.25 * sum((a[i][k] - a[i - 1][k]) ** 2 for k in range(3)) + 0.4 * sum((b[i][k] - b[i - 1][k]) ** 2 for k in range(3))
        sine = offset / 0.2
        lost = (1 - restitution ** 2) * (1 - sine ** 2) * 0.8 / 1.3
        worst = max(worst, abs(energy(hit + 3) / energy(hit - 1) - (1 - lost)))
        highest = max(highest, *(abs(p[2] - rest) for track in (a, b) for p in track[hit:hit + 6]))
    return worst, highest


@scene(GROUP)
def dynamics3d_phases(lab):
    phases = 10 if lab.quick else 40
    cases = [("disc", 5, 1, 0.1), ("disc", 1, 1, 0), ("cube", 5, 0.5, 0)]
    if not lab.quick:
        cases += [("disc", 5, 1, 0), ("disc", 2, 1, 0.1), ("disc", 1, 0.5, 0.1), ("cube", 2, 1, 0), ("cube", 1, 0.5, 0)]
    for shape, step_ms, restitution, offset in cases:
        worst, highest = collide(lab, shape, step_ms, restitution, offset, phases)
        name = f"dynamics3d: {shape}s collide at all phases of {step_ms} ms, e = {restitution}, offset {offset} m"
        yield Row(f"{name}, E₁/E₀", "1 - (1 - e²) cos² α M / (m + M)", COLLISION, 0, worst, 1e-3, "0.1 %")
        yield Row(f"{name}, jump", "0", COLLISION, 0, highest, 2e-4, "0.2 mm", "m")


@scene(GROUP)
def dynamics3d_fast_bodies(lab):
    """Thin plates are dropped from 20 m onto a thin board."""
    arena = block("floor", "5,5,1", "8,8,0.02")
    for k in range(10):
        arena += block(f"p{k}", f"{2 + 0.6 * k!r},5,{21 + 0.01 * k!r}", "0.2,0.2,0.01", movable="true", mass=0.2)
    result = lab.run(arena, "", "dynamics3d", 30, size="10,10,30", ground="false")
    lowest = min(result.track(f"p{k}")[-1][2] for k in range(10))
    yield Row("dynamics3d: plates of 1 cm at 20 m/s on a board of 2 cm, lowest", "they lie on it", "docs/engines.md", 1.015, lowest, 1e-3, "1 mm", "m")


def climb(lab, degrees, mu):
    who = probe("c", [(5, 1000, "footbot_wheels", 0.1, 0.1)])
    robot = footbot("fb", 0.0, 0.0, 0, "c").replace('position="0.0,0.0,0"', f'position="{on_incline(-degrees, 0, 0)}"').replace('orientation="0,0,0"', f'orientation="0,{-degrees},0"')
    result = lab.run(robot, who, "dynamics3d", 40, size="20,20,20", orientation=f"0,{-degrees},0", position="10,10,10", wheel_friction=mu, friction=0)
    return [p[2] for p in result.track("fb")]


@scene(GROUP)
def dynamics3d_climb(lab):
    for mu in (1, 0.4):
        # Only the lower caster touches: N of the wheels is m g (cos α - sin α h / r), and they must hold m g sin α.
        limit = math.degrees(math.atan(mu / (1 + mu * CENTRE / CASTER)))
        for part, expected in ((0.9, 1), (1.1, 0)):
            z = climb(lab, part * limit, mu)
            yield Row(f"dynamics3d: footbot on a slope of {part} times its limit, µ = {mu}, climbs", "tan α < µ / (1 + µ h / r)", STATICS, expected,
                      float(z[-1] - z[20] > 0.05), 0, "yes or no")


@scene(GROUP)
def dynamics3d_slip(lab):
    mu = 0.2
    who = probe("c", [(0, 1000, "footbot_wheels", 0.3, 0.3)], sensors={"footbot_encoders": {}})
    result = lab.run(footbot("fb", 2.0, 5.0, 0, "c"), who, "dynamics3d", 40, 10, wheel_friction=mu)
    x = [p[0] for p in result.track("fb")]
    slip = 0.3 - (x[12] - x[4]) / 0.08
    expected = 0.77 * mu * G * (1 + 0.5 * slip)
    yield Row("dynamics3d: start with spinning wheels, acceleration", "0.77 µ g (1 + 0.5 s/m v), v the slip", "docs/engines.md", expected,
              (x[12] - 2 * x[8] + x[4]) / 0.04 ** 2, 0.05 * expected, "5 %, pitch", "m/s²")
    turned = [now["left"] * WHEEL for now in result.readings("fb", "footbot_encoders")]
    yield Row("dynamics3d: rim of a spinning wheel by its encoder", "as commanded", "docs/engines.md", 0.3, turned[12], 0.003, "1 %", "m/s")
    yield Row("dynamics3d: robot whose wheels spin, speed", "less than its rim", COULOMB, 1, float((x[13] - x[11]) / 0.02 < 0.25), 0, "yes or no")
    for friction in (0.2, 0.6):
        arena = footbot("a", 4.85, 5.0, 0, "c") + footbot("b", 5.15, 5.0, 180, "c")
        result = lab.run(arena, who, "dynamics3d", 150, wheel_friction=friction)
        middle = [(p[0] + q[0]) / 2 for p, q in zip(result.track("a"), result.track("b"))]
        yield Row(f"dynamics3d: equal footbots head-on with spinning wheels, friction {friction}, drift", "0", "symmetry", 0, (middle[-1] - middle[50]) / 10, 5e-4,
                  "promised", "m/s")


@scene(GROUP)
def dynamics3d_standing_handbot(lab):
    seconds = 30 if lab.quick else 600
    track = lab.run(element("handbot", {"id": "h", "position": "5,5,0"}), "", "dynamics3d", 10 * seconds, every=100).track("h")
    yield Row("dynamics3d: standing handbot, creep", "0", STATICS, 0, math.dist(track[-1][:3], track[0][:3]), 5e-4, "0.5 mm", "m")


def ramp(path, pixels, slope):
    """A heightmap, 16 bits, that rises along x."""
    rows = b"".join(b"\0" + b"".join(struct.pack(">H", round(65535 * x / (pixels - 1) * slope)) for x in range(pixels)) for _ in range(pixels))
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", pixels, pixels, 16, 0, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


@scene(GROUP)
def dynamics3d_terrain(lab):
    ramp(lab.folder / "ramp.png", 41, 1.0)
    terrain = element("terrain", {"id": "t"}, element("heightmap", {"file": lab.folder / "ramp.png", "size": "4,4", "height": 0.6}))
    who = probe("c", [(10, 1000, "footbot_wheels", 0.1, 0.1)])
    angle = math.atan(0.6 / 4)
    result = lab.run(terrain + footbot("fb", 1.0, 2.0, 0, "c", z=0.16) + footbot("still", 1.0, 3.0, 0, z=0.16), who, "dynamics3d", 150, ground="false", size="10,10,4")
    p = result.track("fb")
    rate = [(p[-1][k] - p[30][k]) / ((len(p) - 31) * 0.1) for k in range(3)]
    yield Row("dynamics3d: footbot up a heightmap of 8.5°, speed along x", "v cos α", "geometry", 0.1 * math.cos(angle), rate[0], 1e-3, "1 %", "m/s")
    yield Row("dynamics3d: footbot up a heightmap of 8.5°, rise", "v sin α", "geometry", 0.1 * math.sin(angle), rate[2], 3e-4, "0.3 % of v", "m/s")
    yield Row("dynamics3d: footbot on a heightmap of 8.5°, height above it", "z = x tan α", "geometry", 0, p[-1][2] - p[-1][0] * 0.15, 1.5e-3, "wheels sink", "m")
    q = result.track("still")
    yield Row("dynamics3d: braked footbot on a heightmap of 8.5°, creep in 10 s", "0", COULOMB, 0, math.dist(q[-1][:3], q[50][:3]), 5e-3, "0.5 mm/s, 8 iterations", "m")


@scene(GROUP)
def dynamics3d_leaning_sensors(lab):
    degrees = 15
    a = math.radians(degrees)
    who = probe("c", [(0, 1000, "range_and_bearing", 7)], sensors={"footbot_accelerometer": {}, "range_and_bearing": {}, "footbot_proximity": {}})
    def placed(name, x, z=0):
        return footbot(name, 0.0, 0.0, 0, "c").replace('position="0.0,0.0,0"', f'position="{on_incline(degrees, x, z)}"').replace('orientation="0,0,0"', f'orientation="0,{degrees},0"')
    wall = block("w", on_incline(degrees, 0.19, 0.1), "0.1,1,0.2", orientation=f"0,{degrees},0")
    result = lab.run(placed("low", 0) + placed("high", -1.0) + wall, who, "dynamics3d", 30, size="20,20,20", orientation=f"0,{degrees},0", position="10,10,10")
    lean = math.radians(result.track("low")[-1][4])
    felt = result.readings("low", "footbot_accelerometer")[-1]
    yield Row("dynamics3d: footbot on a slope of 15°, accelerometer ahead", "-g sin β", "definition", -G * math.sin(lean), felt["forward"], 1e-3, "0.01 %", "m/s²")
    yield Row("dynamics3d: footbot on a slope of 15°, accelerometer up", "g cos β", "definition", G * math.cos(lean), felt["up"], 1e-3, "0.01 %", "m/s²")
    yield Row("dynamics3d: footbot on a slope of 15°, lean", "slope, springs of casters", STATICS, a, lean, 0.015, "0.9°", "rad")
    heard = result.readings("low", "range_and_bearing")[-1]
    yield Row("dynamics3d: range and bearing of footbots on a slope, range", "along the slope", "geometry", 1.0, heard["packet 0 range"], 2e-3, "springs", "m")
    yield Row("dynamics3d: range and bearing of footbots on a slope, vertical bearing", "lean against the slope", "geometry", 0, heard["packet 0 vertical bearing"], 0.02, "lean", "rad")
