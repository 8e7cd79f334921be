// What experiment functions draw on the page of web_render, in headless Chromium, and keys and selections that reach them. Ends with 77
// if there is no browser.
//
// Environment: see harness.mjs, and optionally PICTURES, a folder for what the pages look like.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { eventually, experiment, folder, open, pixelsOf, Process, runCases } from "./harness.mjs";

const { PICTURES } = process.env;

async function show(url, quality) {
  const page = await open(url, { quality, viewport: { width: 900, height: 560 } });
  await page.waitForFunction(() => window.swarmanoid?.drawn > 0);
  return page;
}
// How many pixels of the page are green as the disc and its rim are, and how many blue as the ways.
async function coloursOf(page) {
  const found = { green: 0, blue: 0, magenta: 0 };
  for (const [r, g, b] of await pixelsOf(page, await page.screenshot())) {
    if (g > r + 60 && g > b + 40) found.green++;
    if (b > r + 90 && b > g + 50) found.blue++;
    if (r > g + 120 && b > g + 120) found.magenta++;
  }
  return found;
}

const tests = {
  async "both views show what is drawn, and keys and selections change it, in one process"() {
    const run = new Process("run", experiment("drawn_swarm"), "--show", "web", "--single-process", "--real-time", 10, "--ticks", 100000, "--output", "one");
    const [, url] = await run.says(/web_render: (http\S+)/);
    const log = join(folder, "one", "events.csv");
    let views = 0;
    for (const quality of ["plan", "low"]) {
      const page = await show(url, quality);
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
      assert.ok(colours.magenta < 10, "no robot is selected");
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
      const events = new RegExp(`(select,fb_3,[^]*press,C,[^]*release,C,[^]*deselect,,[^]*){${++views}}`);
      await eventually(events, () => existsSync(log) && events.test(readFileSync(log, "utf8")));
      // The key is the page's again.
      await page.keyboard.press("c");
      await page.close();
    }
  },

  async "a page that is attached to a cluster shows it, and the command has keys, too"() {
    const run = new Process("run", experiment("drawn_swarm"), "--no-visualisers", "--quiet", "--real-time", 10, "--ticks", 100000, "--output", "cluster");
    const attached = new Process("attach", "web", "drawn_swarm");
    const page = await show((await attached.says(/web_render: (http\S+)/))[1], "plan");
    await page.waitForFunction(() => swarmanoid.drawing?.texts.length === 10 && swarmanoid.tick > 60);
    const lines = await page.evaluate(() => swarmanoid.drawing.lines);
    const select = new Process("control", "select", "fb_5");
    await select.ended;
    assert.match(select.output, /selected 'fb_5' at tick \d+/);
    await page.waitForFunction((before) => swarmanoid.drawing.lines >= before + 36, lines);
    const wrong = new Process("control", "press", "nothing");
    await wrong.ended;
    assert.match(wrong.output, /there is no key 'nothing'/);
  },
};

await runCases(tests);
