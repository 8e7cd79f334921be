// Draws the drawings of experiment functions in three dimensions; `drawing` is that of drawing_reader.js. The overlay draws
// their texts.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

export class Drawing3d {
  constructor(scene) {
    this.group = new THREE.Group();
    scene.add(this.group);
  }

  update(drawing) {
    if (drawing === this.drawing) return;
    this.drawing = drawing;
    for (const thing of this.group.children) {
      thing.geometry.dispose();
      thing.material.dispose();
    }
    this.group.clear();
    if (!drawing) return;
    for (const group of drawing.triangles) this.add(triangles(group), group);
    for (const group of drawing.lines) this.add(lines(group), group);
    for (const group of drawing.dots) this.add(dots(group), group);
  }

  add(thing, { opacity }) {
    thing.frustumCulled = false;
    thing.renderOrder = opacity < 1 ? 3 : 2;
    this.group.add(thing);
  }
}

const look = ({ colour, opacity }) => ({ color: colour, opacity, transparent: opacity < 1, depthWrite: opacity === 1 });
const places = (points) => new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));

function triangles(group) {
  const over = { side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -4 };
  return new THREE.Mesh(places(group.points), new THREE.MeshBasicMaterial({ ...look(group), ...over }));
}

// The lines have their width in pixels, which WebGL's own lines lack.
function lines(group) {
  const geometry = new LineSegmentsGeometry().setPositions(group.points);
  return new LineSegments2(geometry, new LineMaterial({ ...look(group), linewidth: group.width, polygonOffset: true, polygonOffsetFactor: -3, polygonOffsetUnits: -6 }));
}

function dots(group) {
  const material = new THREE.PointsMaterial({ ...look(group), size: group.width * Math.min(window.devicePixelRatio || 1, 2), sizeAttenuation: false });
  // Dots are drawn like balls, so that the ground under them hides no half of them.
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      "gl_PointSize = size;",
      "gl_PointSize = size;\n  gl_Position.z += projectionMatrix[3][2] * size / (2.0 * scale * projectionMatrix[1][1]);",
    );
    shader.fragmentShader = shader.fragmentShader.replace("void main() {", "void main() {\n  if (length(gl_PointCoord - 0.5) > 0.5) discard;");
  };
  return new THREE.Points(places(group.points), material);
}
