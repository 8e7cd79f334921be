// Records a film of the picture as the browser draws it, until it is stopped, and saves it.
import { h, saveBlob } from "./ui/dom.js";

const RATE = 30; // the most pictures a second
const BITS_A_PIXEL = 4; // for each second
const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

export class Film {
  // `actions`: fileName(), changed(on), trouble(text).
  constructor(picture, actions) {
    this.picture = picture;
    this.actions = actions;
    this.recorder = null;
  }

  toggle() {
    if (this.recorder) this.recorder.stop();
    else this.begin();
  }

  begin() {
    const type = globalThis.MediaRecorder && TYPES.find((each) => MediaRecorder.isTypeSupported(each));
    if (!type) return this.actions.trouble("This browser cannot film; P saves single pictures.");
    const { canvas } = this.picture.view;
    // Video encoders need an even size. The size stays if the window changes.
    [this.width, this.height] = [canvas.width & ~1, canvas.height & ~1];
    this.canvas = h("canvas", { width: this.width, height: this.height });
    this.context = this.canvas.getContext("2d", { alpha: false });
    const name = this.actions.fileName();
    const parts = [];
    this.recorder = new MediaRecorder(this.canvas.captureStream(RATE), { mimeType: type, videoBitsPerSecond: BITS_A_PIXEL * this.width * this.height });
    this.recorder.ondataavailable = ({ data }) => data.size > 0 && parts.push(data);
    this.recorder.onstop = () => {
      this.recorder = null;
      this.actions.changed(false);
      saveBlob(new Blob(parts, { type }), `${name}.${type.includes("mp4") ? "mp4" : "webm"}`);
    };
    this.recorder.start(1000);
    this.actions.changed(true);
    this.picture.invalidate();
  }

  // Called after each picture.
  draw() {
    if (!this.recorder) return;
    const { picture, context } = this;
    context.drawImage(picture.view.canvas, 0, 0, this.width, this.height);
    if (!picture.overlay.canvas.hidden) context.drawImage(picture.overlay.canvas, 0, 0, this.width, this.height);
  }
}
