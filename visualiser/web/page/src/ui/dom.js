// Small functions for the panels.

// h("button.big", { title: "…", onclick }, "text", child)
export function h(what, attributes = {}, ...children) {
  const [tag, ...classes] = what.split(".");
  const element = document.createElement(tag || "div");
  element.className = classes.join(" ");
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

// Writes only changed texts, so that the browser need not lay out the page again.
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function fixed(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  return (Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value).toFixed(digits);
}

// Returns 12345.6 s as 3:25:45.6.
export function clockText(seconds) {
  const hours = Math.floor(seconds / 3600);
  const minutes = Math.floor((seconds % 3600) / 60);
  const rest = (seconds % 60).toFixed(1).padStart(4, "0");
  return hours > 0 ? `${hours}:${String(minutes).padStart(2, "0")}:${rest}` : `${minutes}:${rest}`;
}

export const hex = (colour) => `#${(colour & 0xffffff).toString(16).padStart(6, "0")}`;

const shapes = {
  pause: "M4 2.5h3v11H4zM9 2.5h3v11H9z",
  resume: "M4 2.2v11.6L13.5 8z",
  step: "M3 2.5v11L10.5 8zM11 2.5h2.2v11H11z",
  back: "M13 2.5v11L5.5 8zM2.8 2.5H5v11H2.8z",
  stop: "M3.2 3.2h9.6v9.6H3.2z",
  reset: "M2.8 2.5H5v11H2.8zM13.5 2.2v11.6L5 8z",
};

export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "shape");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", shapes[name]);
  svg.append(path);
  return svg;
}

// Downloads the blob.
export function saveBlob(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name.replaceAll(/[^\w.-]+/g, "_") });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
