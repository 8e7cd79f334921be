// The token of an address that may control the run. It is kept for this tab, removed from the address bar, and never
// sent. It answers the server's challenge by HMAC-SHA256 (RFC 2104, FIPS 180-4). The algorithm is written out here,
// since a page from another machine without encryption has no crypto.subtle.
import { keep, kept } from "./storage.js";

const KEY = "swarmanoid.token";
const BLOCK = 64; // bytes

// Returns the token of the address, or the one that this tab has kept; null if none exists.
export function takeToken() {
  const fields = new URLSearchParams(location.hash.slice(1));
  const given = fields.get("token");
  if (given) {
    keepToken(given);
    fields.delete("token");
    const rest = fields.toString();
    history.replaceState(null, "", location.pathname + location.search + (rest ? `#${rest}` : ""));
  }
  return given ?? kept("sessionStorage", KEY);
}

export function keepToken(token) {
  keep("sessionStorage", KEY, token);
}

// Returns the answer of the token's holder to a challenge, in hexadecimal digits.
export function proofOf(token, challenge) {
  const [key, text] = [token, challenge].map((each) => new TextEncoder().encode(each));
  const padded = (byte) => Uint8Array.from({ length: BLOCK }, (_, i) => (key[i] ?? 0) ^ byte);
  return [...sha256(joined(padded(0x5c), sha256(joined(padded(0x36), text))))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

const joined = (a, b) => Uint8Array.from([...a, ...b]);

const primes = [];
for (let n = 2; primes.length < 64; n++) if (primes.every((prime) => n % prime !== 0)) primes.push(n);
const fraction = (value) => Math.floor((value % 1) * 2 ** 32);
const ROUNDS = primes.map((prime) => fraction(Math.cbrt(prime)));
const START = primes.slice(0, 8).map((prime) => fraction(Math.sqrt(prime)));

const turned = (word, bits) => (word >>> bits) | (word << (32 - bits));

function sha256(bytes) {
  const blocks = Math.ceil((bytes.length + 9) / BLOCK);
  const data = new DataView(new ArrayBuffer(BLOCK * blocks));
  new Uint8Array(data.buffer).set(bytes);
  data.setUint8(bytes.length, 0x80);
  data.setUint32(BLOCK * blocks - 4, 8 * bytes.length);
  const sum = [...START];
  const words = new Int32Array(64);
  for (let block = 0; block < blocks; block++) {
    for (let i = 0; i < 16; i++) words[i] = data.getInt32(BLOCK * block + 4 * i);
    for (let i = 16; i < 64; i++) {
      const [a, b] = [words[i - 15], words[i - 2]];
      words[i] = words[i - 16] + (turned(a, 7) ^ turned(a, 18) ^ (a >>> 3)) + words[i - 7] + (turned(b, 17) ^ turned(b, 19) ^ (b >>> 10));
    }
    let [a, b, c, d, e, f, g, h] = sum;
    for (let i = 0; i < 64; i++) {
      const first = (h + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) + ((e & f) ^ (~e & g)) + ROUNDS[i] + words[i]) | 0;
      const second = ((turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c))) | 0;
      [a, b, c, d, e, f, g, h] = [(first + second) | 0, a, b, c, (d + first) | 0, e, f, g];
    }
    [a, b, c, d, e, f, g, h].forEach((word, i) => (sum[i] = (sum[i] + word) | 0));
  }
  const result = new DataView(new ArrayBuffer(32));
  sum.forEach((word, i) => result.setInt32(4 * i, word));
  return new Uint8Array(result.buffer);
}
