// Returns whether the text was copied to the clipboard. If the browser refuses, the text is shown under a title for
// copying by hand.
export async function copyOrShow(title, text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    prompt(title, text);
    return false;
  }
}
