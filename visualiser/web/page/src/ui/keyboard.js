// Calls the actions of the page's keys, unless the user types text.

// `keys`: functions by event.key, or by its lower case; digit(number, event): with Ctrl; first(event): true if it has
// used the key; isReady().
export function listenToKeys({ keys, digit, first, isReady }) {
  window.addEventListener("keydown", (event) => {
    if (first(event)) return;
    const found = /^Digit(\d)$/.exec(event.code);
    if (found && event.ctrlKey && !event.altKey && isReady()) {
      event.preventDefault();
      return digit(Number(found[1]), event);
    }
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "Escape") document.activeElement?.blur();
    else if (["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName)) return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!act || !isReady()) return;
    event.preventDefault();
    act();
  });
}
