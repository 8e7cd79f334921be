// What experiment functions draw on the page of web_render, in headless Chromium, and keys and selections that reach them. Ends with 77
// if there is no browser.
//
// Environment: as page_test.mjs, and optionally PICTURES, a folder for what the pages look like.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const { SWARMANOID, SWARMANOID_CONFIGS, PAGE_MODULES, PICTURES } = process.env;
const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((path) => existsSync(path));
const TIMEOUT_MS = 100000; // which only what hangs reaches
if (!CHROMIUM || !existsSync(join(PAGE_MODULES, "playwright-core"))) {
  console.log("skipped: there is no Chromium, or the page was not built");
  process.exit(77);
}
const { chromium } = createRequire(join(PAGE_MODULES, "here.js"))("playwright-core");

const folder = mkdtempSync(join(tmpdir(), "swarmanoid_drawing_"));
process.env.SWARMANOID_SHARED_FOLDER = `/dev/shm/swarmanoid-drawing-${process.pid}`;
process.env.XDG_STATE_HOME = join(folder, "state");
const children = [];

function start(...words) {
  const child = spawn(SWARMANOID, words.map(String), { cwd: folder });
  child.output = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (text) => (child.output += text));
  child.ended = new Promise((done) => child.on("close", done));
  children.push(child);
  return child;
}
async function says(child, pattern) {
  const deadline = Date.now() + TIMEOUT_MS;
  while (Date.now() < deadline && child.exitCode === null) {
    const match = pattern.exec(child.output);
    if (match) return match[1];
    await new Promise((done) => setTimeout(done, 20));
  }
  throw new Error(`no ${pattern} in the output: ${child.output}`);
}

// Until a file is so.
async function written(file, pattern) {
  const deadline = Date.now() + TIMEOUT_MS;
  while (!(existsSync(file) && pattern.test(readFileSync(file, "utf8")))) {
    assert.ok(Date.now() < deadline, `no ${pattern} in ${existsSync(file) ? readFileSync(file, "utf8") : file}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

const browser = await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
async function open(url, quality) {
  const page = await browser.newPage({ viewport: { width: 900, height: 560 } });
  page.setDefaultTimeout(TIMEOUT_MS);
  page.complaints = [];
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  const address = new URL(url);
  address.searchParams.set("quality", quality);
  await page.goto(address.href);
  await page.waitForFunction(() => window.swarmanoid?.drawn > 0);
  return page;
}
// How many pixels of the page are green as the disc and its rim are, and how many blue as the ways.
async function coloursOf(page) {
  const png = await page.screenshot();
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const found = { green: 0, blue: 0, magenta: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = data.subarray(i, i + 3);
      if (g > r + 60 && g > b + 40) found.green++;
      if (b > r + 90 && b > g + 50) found.blue++;
      if (r > g + 120 && b > g + 120) found.magenta++;
    }
    return found;
  }, png.toString("base64"));
}

const checks = {
  async "both views show what is drawn, and keys and selections change it, in one process"() {
    const run = start("run", join(SWARMANOID_CONFIGS, "drawn_swarm.xml"), "--show", "web", "--single-process", "--real-time", 10, "--ticks", 100000, "--output", "one");
    const url = await says(run, /web_render: (http\S+)/);
    let views = 0;
    for (const quality of ["plan", "low"]) {
      const page = await open(url, quality);
      await page.waitForFunction(() => swarmanoid.control === "granted" && swarmanoid.drawing?.texts.length === 10 && swarmanoid.tick > 60);
      await page.waitForFunction((view) => swarmanoid.view === view, quality === "plan" ? "plan" : "3D");
      const drawing = await page.evaluate(() => swarmanoid.drawing);
      assert.ok(drawing.texts.includes("fb_3"));
      // The disc and the cylinder; its rim, the arrows and the ways; where these begin.
      assert.ok(drawing.triangles >= 36 + 144 + 10 && drawing.lines > 36 + 10 && drawing.dots === 10, JSON.stringify(drawing));
      // A screenshot of a busy machine may come before the browser has put the picture.
      let colours = await coloursOf(page);
      for (let tries = 0; colours.green <= 300 && tries < 50; ++tries) colours = await coloursOf(page);
      assert.ok(colours.green > 300 && colours.blue > 100, `${quality}: ${JSON.stringify(colours)}`);
      assert.ok(colours.magenta < 10, "nobody is selected");
      if (PICTURES) await page.screenshot({ path: join(PICTURES, `drawing_${quality}.png`) });

      // The ring about who is selected is drawn by the functions.
      await page.evaluate(() => swarmanoid.select("fb_3"));
      const circles = await page.evaluate(() => swarmanoid.drawing.lines);
      await page.keyboard.press("F8");
      await page.waitForFunction((before) => swarmanoid.drawing.lines >= before + 36, circles);
      if (PICTURES) await page.screenshot({ path: join(PICTURES, `selected_${quality}.png`) });
      // Ways grow by two lines a tick. After they were cleared they grow again, so a page that draws seldom never sees few.
      const ways = await page.evaluate(() => [swarmanoid.drawing.lines, swarmanoid.tick]);
      await page.keyboard.press("c");
      await page.waitForFunction(([lines, tick]) => swarmanoid.drawing.lines < lines / 2 + 1.9 * (swarmanoid.tick - tick), ways);
      await page.keyboard.press("F8");
      await written(join(folder, "one", "events.csv"), new RegExp(`(select,fb_3,[^]*press,C,[^]*release,C,[^]*deselect,,[^]*){${++views}}`));
      // The key is the page's again.
      await page.keyboard.press("c");
      assert.deepEqual(page.complaints, []);
      await page.close();
    }
    run.kill("SIGINT");
    await run.ended;
  },

  async "a page that is attached to a cluster shows it, and the command has keys, too"() {
    const run = start("run", join(SWARMANOID_CONFIGS, "drawn_swarm.xml"), "--no-visualisers", "--quiet", "--real-time", 10, "--ticks", 100000, "--output", "cluster");
    const attached = start("attach", "web", "drawn_swarm");
    const page = await open(await says(attached, /web_render: (http\S+)/), "plan");
    await page.waitForFunction(() => swarmanoid.drawing?.texts.length === 10 && swarmanoid.tick > 60);
    const lines = await page.evaluate(() => swarmanoid.drawing.lines);
    const select = start("control", "select", "fb_5");
    await select.ended;
    assert.match(select.output, /selected 'fb_5' at tick \d+/);
    await page.waitForFunction((before) => swarmanoid.drawing.lines >= before + 36, lines);
    const wrong = start("control", "press", "nothing");
    await wrong.ended;
    assert.match(wrong.output, /there is no key 'nothing'/);
    run.kill("SIGINT");
    await run.ended;
    attached.kill("SIGINT");
    await attached.ended;
  },
};

let failed = 0;
try {
  for (const [name, check] of Object.entries(checks)) {
    try {
      await check();
      console.log(`ok: ${name}`);
    } catch (error) {
      failed++;
      console.log(`FAILED: ${name}\n${error.stack}`);
    }
  }
} finally {
  await browser.close();
  for (const child of children) child.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);
