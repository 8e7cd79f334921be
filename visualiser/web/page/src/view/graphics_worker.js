// Tests for the page whether WebGL is drawn by the processor: true, false, or null if a worker cannot find out.
import { drawsInSoftware } from "./graphics.js";

postMessage(typeof OffscreenCanvas === "undefined" ? null : drawsInSoftware(new OffscreenCanvas(1, 1)));
