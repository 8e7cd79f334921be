// Draws a picture on a patch of the floor onto a canvas. The server sends runs of pixels in the colours of a palette,
// and each colour is multiplied by the tint. The first row has the highest y.
export function floorPicture({ columns, rows, palette, runs }, tint = 0xffffff) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [columns, rows];
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  const bytes = palette.map((colour) => [16, 8, 0].map((shift) => (((colour >> shift) & 255) * ((tint >> shift) & 255)) / 255));
  let place = 0;
  for (let k = 0; k < runs.length; k += 2)
    for (let n = 0; n < runs[k]; n++) {
      image.data.set(bytes[runs[k + 1]], place);
      image.data[place + 3] = 255;
      place += 4;
    }
  context.putImageData(image, 0, 0);
  return canvas;
}
