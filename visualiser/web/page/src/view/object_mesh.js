// The meshes that objects of an experiment name (world.meshes). They have size 1 and are scaled by the size of each
// object.
import * as THREE from "three";

// The geometry has colours at its vertices if the file has colours. Then the colours of the entities are not used.
export function meshGeometry({ levels: [{ positions, normals, index_steps: steps, colours }] }) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  if (colours) {
    const colour = new THREE.Color();
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours.flatMap((rgb) => colour.set(rgb).toArray()), 3));
  }
  let index = 0;
  return geometry.setIndex(steps.map((step) => (index += step)));
}

export const isPainted = (model) => model.levels[0].colours !== undefined;
