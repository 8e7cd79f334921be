// Calls the actions of the page's keys, unless the user types text or the key works a control that has the focus.

const OTHER_INPUTS = ["range", "checkbox", "radio", "button", "submit", "color", "file"];
const RANGE_KEYS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"];

// Returns whether the element takes text.
export function takesText({ tagName, type, isContentEditable }) {
  return tagName === "TEXTAREA" || Boolean(isContentEditable) || (tagName === "INPUT" && !OTHER_INPUTS.includes(type));
}

// Returns whether the key works the element. After a click, buttons do not keep the space bar from the page.
export function works(element, key) {
  if (takesText(element)) return true;
  if (element.tagName === "SELECT") return RANGE_KEYS.includes(key) || key === " " || key === "Enter";
  if (element.tagName === "INPUT") return RANGE_KEYS.includes(key);
  return ["BUTTON", "SUMMARY", "A"].includes(element.tagName) && (key === " " || key === "Enter") && element.matches(":focus-visible");
}

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
    else if (works(event.target, event.key)) return;
    const act = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!act || !isReady()) return;
    event.preventDefault();
    act();
  });
}
