// The viewpoints of the experiment and those that the user stores: the menu that recalls them, their keys, and the
// flight through them.
import { Flight, cameraOf, viewOf, viewpointXml } from "../view/viewpoints.js";
import { h } from "./dom.js";

const MOST = 10;

export class ViewpointsMenu {
  // `picture`: of the page; world(): of the experiment; tell(text); left(): called when the camera stops following.
  constructor({ picture, world, tell, left }) {
    Object.assign(this, { picture, world, tell, left });
    this.cameras = [];
    this.element = h("select", { "aria-label": "Viewpoint", onchange: () => this.element.value !== "" && this.recall(Number(this.element.value)) });
  }

  // `list`: {number, position, heading, pitch, roll} of each.
  set(list) {
    this.cameras = [];
    for (const { number, ...camera } of list) this.cameras[number] = camera;
    this.show();
  }

  get all() {
    return Object.values(this.cameras);
  }

  show() {
    const numbers = Object.keys(this.cameras);
    this.element.replaceChildren(h("option", { value: "" }, numbers.length > 0 ? "…" : "none"), ...numbers.map((number) => h("option", { value: number }, number)));
  }

  recall(number) {
    const camera = this.cameras[number];
    if (!camera) return this.tell(`there is no viewpoint ${number}; Ctrl + shift + ${number} keeps this view as one`);
    this.picture.stand(camera);
    this.left();
  }

  // Without a number, the next free one is used.
  async store(number = this.free) {
    const camera = cameraOf(this.picture.view.viewpoint);
    this.cameras[number] = camera;
    this.show();
    const xml = viewpointXml(number, camera);
    this.tell(`viewpoint ${number}: ${xml.replace("\n", " ")}`);
    await navigator.clipboard?.writeText(xml).catch(() => {}); // the browser may refuse the copy; the log has the text
  }

  get free() {
    return [...Array(MOST).keys()].find((number) => !this.cameras[number]) ?? MOST - 1;
  }

  fly() {
    if (this.all.length < 2) return this.tell("a flight needs two viewpoints; Keep view keeps this one");
    const [width, depth] = this.world().arena;
    this.picture.fly(new Flight(this.all.map((camera) => viewOf(camera, Math.max(width, depth))), performance.now()));
  }
}
