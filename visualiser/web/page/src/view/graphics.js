// Finds out whether WebGL is drawn by the processor, as on remote desktops and virtual machines, or is missing. The
// test may take half a second, so a worker does it (graphics_worker.js) while the page continues.

const PATIENCE_MS = 3000;

// `canvas`: an unused one.
export function drawsInSoftware(canvas) {
  // Browsers that know the answer refuse at once, without starting to draw in software.
  const gl = canvas.getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return true;
  const found = isSoftware(gl);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return found;
}

export function isSoftware(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)));
}

// Returns a promise of that answer. `hasWorker`: whether the file of the worker can be fetched.
export function findGraphics(hasWorker) {
  return new Promise((answer) => {
    const ask = () => answer(drawsInSoftware(document.createElement("canvas")));
    if (!hasWorker) return ask();
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
