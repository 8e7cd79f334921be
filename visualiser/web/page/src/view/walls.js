// Walls at the edge of the arena, cut open as in the other renderers (visualiser/scene/picking.cpp,
// visualiser/gl/draw_list.cpp). Walls between the eye and the arena are cut down to a kerb; the others are cut above
// the height of the robots.
import * as THREE from "three";

const KERB_M = 0.04;
const CUT_M = 0.35;
const CUT_PART = 0.07; // relative to the arena's size, if that is more

export class BoundaryWall {
  // makeSolid(geometry, colour, more): a mesh, as the arena makes its solids.
  constructor({ size: [x, y, z], position, orientation }, arena, colour, makeSolid) {
    this.height = z;
    this.cut = Math.max(CUT_M, CUT_PART * Math.max(arena[0], arena[1]));
    this.position = new THREE.Vector3(...position);
    this.across = new THREE.Vector3(x < y ? 1 : 0, x < y ? 0 : 1, 0).applyQuaternion(new THREE.Quaternion(...orientation));
    this.inside = new THREE.Vector3(arena[0] / 2, arena[1] / 2, arena[2] / 2).sub(this.position).dot(this.across);

    const box = new THREE.BoxGeometry(x, y, z);
    this.glass = makeSolid(box, colour, { transparent: true, depthWrite: false });
    this.glass.castShadow = this.glass.receiveShadow = false;
    this.edges = new THREE.LineSegments(
      new THREE.EdgesGeometry(box),
      new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity: 0.28 }),
    );
    this.lower = makeSolid(new THREE.BoxGeometry(x, y, 1), colour);
    this.glass.add(this.edges, this.lower);
    this.cutFor(null);
  }

  get object() {
    return this.glass;
  }

  // `eye`: null while there is none.
  cutFor(eye) {
    const hides = eye !== null && this.inside * eye.clone().sub(this.position).dot(this.across) < 0;
    if (hides === this.hides) return;
    this.hides = hides;
    const solid = Math.min(hides ? KERB_M : this.cut, this.height);
    this.lower.scale.z = solid;
    this.lower.position.z = (solid - this.height) / 2;
    this.lower.updateMatrix();
    this.edges.visible = this.glass.material.visible = solid < this.height;
    this.glass.material.opacity = hides ? 0.05 : 0.09;
  }
}
