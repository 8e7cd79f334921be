// What the tests of this folder share: a folder and shared memory of their own, the command, headless Chromium, and the loop that
// runs the cases of a script.
//
// Environment: SWARMANOID (the command), SWARMANOID_CONFIGS, PAGE_MODULES (node_modules with playwright-core).
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

const { SWARMANOID, SWARMANOID_CONFIGS, PAGE_MODULES } = process.env;
export const TIMEOUT_MS = 100000; // which only what hangs reaches

export const folder = mkdtempSync(join(tmpdir(), "swarmanoid_web_"));
process.env.SWARMANOID_SHARED_FOLDER = `/dev/shm/swarmanoid-web-${process.pid}`;
process.env.XDG_STATE_HOME = join(folder, "state");
process.on("exit", () => {
  for (const place of [folder, process.env.SWARMANOID_SHARED_FOLDER]) rmSync(place, { recursive: true, force: true });
});

// A package of npm.
export const load = (name) => createRequire(join(PAGE_MODULES, "here.js"))(name);
export const experiment = (name) => join(SWARMANOID_CONFIGS, `${name}.xml`);
export const textOf = (name) => readFileSync(experiment(name), "utf8");

// Writes a file in the folder and returns its path.
export function write(name, text) {
  const file = join(folder, name);
  writeFileSync(file, text);
  return file;
}

export const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

// Waits until condition() returns something true, and returns it.
export async function eventually(what, condition) {
  for (const deadline = Date.now() + TIMEOUT_MS; Date.now() < deadline; await wait(20)) {
    const found = condition();
    if (found) return found;
  }
  throw new Error(`waited for ${what}; the output is: ${processes.map(({ output }) => output).join("; ")}`);
}

export function freePort() {
  return new Promise((done) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

// ---- processes ----

const processes = [];
export class Process {
  constructor(...words) {
    this.child = spawn(SWARMANOID, words.map(String), { cwd: folder });
    this.output = "";
    for (const stream of [this.child.stdout, this.child.stderr]) stream.on("data", (text) => (this.output += text));
    // With all of its output, which the event `exit` may come before.
    this.ended = new Promise((done) => this.child.on("close", (code) => done((this.code = code ?? -1))));
    processes.push(this);
  }

  // The first match of a pattern in the output, as soon as it is there.
  async says(pattern) {
    const match = await eventually(pattern, () => pattern.exec(this.output) ?? this.code !== undefined);
    if (match !== true) return match;
    throw new Error(`no ${pattern} in the output: ${this.output}`);
  }

  async end(signal = "SIGINT") {
    if (this.code === undefined) this.child.kill(signal);
    return this.ended;
  }
}

// Ends all processes, the last one first.
export const endAll = (signal) => Promise.all(processes.splice(0).reverse().map((one) => one.end(signal)));

// ---- the page ----

export let browser;
const pages = []; // of the present case
// Errors and warnings of its console fail the case. `noise`: patterns of lines that do not. More options are those of a page of Playwright.
export async function open(url, { noise = [], quality = "low", ...more } = {}) {
  const page = await browser.newPage({ viewport: { width: 760, height: 420 }, ...more });
  page.setDefaultTimeout(TIMEOUT_MS);
  page.complaints = [];
  pages.push(page);
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !noise.some((pattern) => pattern.test(message.text())))
      page.complaints.push(message.text());
  });
  const address = new URL(url);
  address.searchParams.set("quality", quality);
  await page.goto(address.href);
  return page;
}
export const until = (page, expression, argument) => page.waitForFunction(expression, argument, { polling: 50, timeout: TIMEOUT_MS });
export const read = (page, expression) => page.evaluate(expression);

// Waits until the picture stands still, and the robot in it: panels that come in and the last push of a hand still move it for some frames.
export async function settled(page, robot) {
  await until(page, (id) => {
    const place = () => JSON.stringify([swarmanoid.camera, id && swarmanoid.project(id), document.querySelector(".picture:not([hidden])").getBoundingClientRect()]);
    const before = place();
    return new Promise((done) => {
      const look = (frames) => requestAnimationFrame(() => (place() !== before ? done(false) : frames === 0 ? done(true) : look(frames - 1)));
      look(4);
    });
  }, robot);
}

// Red, green and blue (0 to 255) of the pixels of a PNG, row by row.
export async function pixelsOf(page, png) {
  const found = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return btoa(text);
  }, png.toString("base64"));
  const bytes = Buffer.from(found, "base64");
  return Array.from({ length: bytes.length / 4 }, (_, i) => [...bytes.subarray(4 * i, 4 * i + 3)]);
}

// What axe-core finds at level AA by day and by night, and targets with less than 24 pixels. The page is opened with
// `bypassCSP`, and goes back to its own scheme of colours.
export async function barriers(page) {
  const found = new Set();
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    for (const barrier of await barriersNow(page)) found.add(`${colorScheme}: ${barrier}`);
  }
  await page.emulateMedia({ colorScheme: null });
  return [...found];
}

async function barriersNow(page) {
  if (!(await page.evaluate(() => "axe" in window))) await page.addScriptTag({ path: join(PAGE_MODULES, "axe-core/axe.min.js") });
  return page.evaluate(async () => {
    const runOnly = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
    const { violations } = await axe.run(document, { runOnly, rules: { "target-size": { enabled: true } } });
    // A list is no target: its options are, which are measured below. What they leave free of it depends on the height of the page.
    const isList = ({ target }) => document.querySelector(target[0])?.getAttribute("role") === "listbox";
    const found = violations.flatMap(({ id, nodes }) =>
      nodes.filter((node) => id !== "target-size" || !isList(node)).map(({ html, failureSummary }) => `${id}: ${html.slice(0, 160)} ${failureSummary}`));
    for (const target of document.querySelectorAll("a[href], button, input, select, textarea, summary, [role=option]")) {
      const { width, height } = target.getBoundingClientRect();
      if (target.checkVisibility({ visibilityProperty: true }) && width > 0 && Math.min(width, height) < 23.9) found.push(`small: ${target.outerHTML.slice(0, 120)} ${width} x ${height}`);
    }
    return found;
  });
}

// ---- running the cases ----

// Runs the cases whose names have one of the words of the command line, or all. Ends the program: with 77 if there is no browser.
// `signal`: ends the processes that a case leaves. `state`: an expression of a page that is shown if a case fails.
export async function runCases(tests, { signal = "SIGINT", state = "null" } = {}) {
  const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((path) => existsSync(path));
  const missing = !executablePath ? "there is no Chromium (package chromium)" : !existsSync(join(PAGE_MODULES, "playwright-core")) && "the page was not built: there is no playwright-core";
  if (missing) {
    console.log(`skipped: ${missing}`);
    process.exit(77);
  }
  const wanted = process.argv.slice(2);
  let failed = 0;
  browser = await load("playwright-core").chromium.launch({ executablePath, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  for (const [name, test] of Object.entries(tests)) {
    if (wanted.length > 0 && !wanted.some((word) => name.includes(word))) continue;
    const start = Date.now();
    try {
      await test();
      for (const { complaints } of pages) assert.deepEqual(complaints, []);
      console.log(`passed: ${name} (${Date.now() - start} ms)`);
    } catch (error) {
      failed++;
      console.log(`FAILED: ${name}\n${error.stack}`);
      for (const page of browser.contexts().flatMap((context) => context.pages())) {
        if (page.complaints?.length) console.log("console:", page.complaints);
        console.log("state:", await page.evaluate(state).catch(() => ""));
      }
      for (const one of processes.slice(0, 4)) console.log("output:", one.output.slice(-600));
    }
    for (const context of browser.contexts()) await context.close();
    pages.length = 0;
    await endAll(signal);
  }
  await browser.close();
  process.exit(failed > 0 ? 1 : 0);
}
