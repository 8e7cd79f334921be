// The report of a study in headless Chromium, as on a phone. Ends with 77 if there is no browser, matplotlib or scipy.
//
// Environment: see harness.mjs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { barriers, experiment, folder, open, Process, read, runCases, write } from "./harness.mjs";

async function done(...words) {
  const process = new Process(...words);
  assert.equal(await process.ended, 0, process.output);
}

const tests = {
  async "the report of a study fits on a phone, and can be read by everybody"() {
    write(
      "a_study_with_a_long_name.xml",
      `<study experiment="${experiment("diffusion_10")}" ticks="40" seeds="1-4"><factor id="velocity_of_the_robots" path="controllers.diffusion.parameters.velocity" values="0.05 0.1"/>
      <factor id="robots" path="arena.distribute.quantity" values="3 6"/>
      <metrics every="10"><distance id="way_of_the_robots" aggregate="mean deviation min max sum median q25 q75"/><coverage id="seen" cell="0.5"/></metrics></study>`,
    );
    await done("sweep", "a_study_with_a_long_name.xml", "--output", "out", "--quiet");
    await done("plot", "out", "--metric", "seen", "--compare", "robots=3,6");
    const page = await open(pathToFileURL(join(folder, "out/pictures/report.html")).href, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, bypassCSP: true });
    await page.waitForSelector("figure svg");
    assert.equal(await read(page, () => document.documentElement.scrollWidth), 390);
    for (const box of await read(page, () => [...document.querySelectorAll("figure, figure svg, h1, h2, p, pre")].map((each) => each.getBoundingClientRect().toJSON())))
      assert.ok(box.left >= 0 && box.right <= 390, JSON.stringify(box));
    // Letters are not shrunk: the page is as wide as the screen.
    assert.equal(await read(page, () => window.visualViewport.scale), 1);
    assert.deepEqual(await barriers(page), []);
    if (process.env.REPORT_PICTURE) await page.screenshot({ path: process.env.REPORT_PICTURE, fullPage: true });
  },
};

try {
  execFileSync("/usr/bin/python3", ["-c", "import matplotlib, scipy"], { stdio: "ignore" });
} catch {
  console.log("skipped: there is no matplotlib or no scipy");
  process.exit(77);
}
await runCases(tests);
