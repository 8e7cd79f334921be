// Whether the text is in the clipboard; a browser that lets no page write there shows it to be copied, under a title.
export async function copyOrShow(title, text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    prompt(title, text);
    return false;
  }
}
