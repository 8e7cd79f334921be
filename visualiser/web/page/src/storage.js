// This module keeps values in the browser, between two visits or for a tab. A page in a sandbox may keep nothing.

export function kept(storage, key) {
  try {
    return window[storage].getItem(key);
  } catch {
    return null;
  }
}

export function keep(storage, key, text) {
  try {
    window[storage].setItem(key, text);
  } catch {
    // The page works without it.
  }
}
