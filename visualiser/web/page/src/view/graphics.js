// Whether WebGL is drawn by the processor, as on remote desktops and virtual machines, or is missing. To ask may take half
// a second, so a worker asks (graphics_worker.js) while the page goes on.

const PATIENCE_MS = 3000;

// canvas: one that nobody uses
export function drawsInSoftware(canvas) {
  // Browsers that know it refuse at once, without starting to draw in software only to be asked.
  const gl = canvas.getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return true;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

// A promise of that answer.
export function findGraphics() {
  return new Promise((answer) => {
    const ask = () => answer(drawsInSoftware(document.createElement("canvas")));
    try {
      const worker = new Worker(new URL("graphics_worker.js", import.meta.url), { type: "module" });
      const late = setTimeout(() => answer(true), PATIENCE_MS);
      worker.onmessage = ({ data }) => {
        clearTimeout(late);
        worker.terminate();
        if (data === null) ask();
        else answer(data);
      };
      worker.onerror = () => {
        clearTimeout(late);
        ask();
      };
    } catch {
      ask();
    }
  });
}
