// Stores a view in the fragment of an address, which browsers do not send to servers: the camera, the selection, and
// the shown parts.

const numbers = (list) => list.map((value) => Number(value.toFixed(4))).join(",");

// `view`: {target, span, direction}; `select`: an id; `shows`: names; `colours`, `quality`: a name. All are optional.
export function writeLink({ view, select, shows, colours, quality }) {
  const fields = new URLSearchParams();
  if (view) {
    fields.set("at", numbers(view.target));
    fields.set("span", numbers([view.span]));
    if (view.direction) fields.set("from", numbers(view.direction));
  }
  if (select) fields.set("select", select);
  if (shows?.length) fields.set("show", shows.join(","));
  if (colours) fields.set("colours", colours);
  if (quality) fields.set("quality", quality);
  return fields.toString();
}

// Reads a fragment; invalid parts are left out.
export function readLink(fragment) {
  const fields = new URLSearchParams(fragment);
  const triple = (name) => {
    const list = (fields.get(name) ?? "").split(",").map(Number);
    return list.length === 3 && list.every((value) => Number.isFinite(value) && Math.abs(value) < 1e6) ? list : null;
  };
  const wanted = {};
  const [target, direction, span] = [triple("at"), triple("from"), Number(fields.get("span"))];
  if (target && span > 0 && span < 1e6) wanted.view = { target, span, direction: direction && Math.hypot(...direction) > 1e-3 ? direction : null };
  for (const name of ["select", "colours", "quality"]) if (fields.get(name)) wanted[name] = fields.get(name);
  if (fields.get("show")) wanted.shows = fields.get("show").split(",");
  return wanted;
}
