// Pages that have their run (`swarmanoid export --html`), in headless Chromium, from a file and without a network; films; and
// archives with a page. Ends with 77 if there is no browser.
//
// Environment: see harness.mjs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { barriers, browser, experiment, folder, open, Process, read, runCases, until, write } from "./harness.mjs";

async function ran(...words) {
  const one = new Process(...words);
  assert.equal(await one.ended, 0, one.output);
  return one.output;
}
const record = (name, output, ...more) => ran("run", experiment(name), "--quiet", "--no-visualisers", "--output", output, ...more);

// The page of a file without a network. It must ask for nothing else.
async function openFile(file, options = {}) {
  const page = await open(`file://${join(folder, file)}`, { quality: "plan", offline: true, ...options });
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || page.complaints.push(`asks for ${request.url()}`));
  await until(page, () => window.swarmanoid?.drawn > 0 && swarmanoid.past !== null);
  return page;
}

async function look(page, tick) {
  await page.evaluate((t) => swarmanoid.lookBack(t), tick);
  await until(page, (t) => swarmanoid.past.shown === t && swarmanoid.tick === t, tick);
}

// The rows of a table as objects.
function rowsOf(table) {
  const [head, ...lines] = table.trim().split("\n").map((line) => line.split(","));
  return lines.map((fields) => Object.fromEntries(head.map((name, i) => [name, fields[i]])));
}

const tests = {
  async "ten robots over 2,000 ticks have less than a megabyte, and play from a disk without a network"() {
    await record("diffusion_10", "ten", "--ticks", 2000);
    const said = await ran("export", "ten", "--html", "ten.html");
    const { size } = statSync(join(folder, "ten.html"));
    assert.ok(size <= 1e6, `${size} bytes`);
    assert.match(said, new RegExp(`ten.html: ${size} bytes, ticks 0 to 2000`));
    const page = await openFile("ten.html");
    assert.equal(await page.title(), "diffusion_10 · Swarmanoid");
    assert.deepEqual(await read(page, () => [swarmanoid.tick, swarmanoid.robots, swarmanoid.control, swarmanoid.phase, swarmanoid.timeline.last]), [0, 10, "read-only", "recorded", 2000]);
    assert.match(await page.textContent("header"), /tick 0 of 2000/);
    assert.equal(await page.isVisible(".banner"), false);
    for (const name of ["End the run", "One tick", "Speed"]) assert.equal(await page.isVisible(`header [aria-label="${name}"]`), false, name);

    await page.keyboard.press(" ");
    await until(page, () => swarmanoid.past.playing && swarmanoid.tick > 5);
    await page.keyboard.press(" ");
    await until(page, () => !swarmanoid.past.playing);
    const tick = await read(page, () => swarmanoid.past.tick);
    await page.click('[aria-label="One tick ahead"]');
    await until(page, (t) => swarmanoid.tick === t, tick + 1);
    await page.click('[aria-label="One tick back"]');
    await page.click('[aria-label="One tick back"]');
    await until(page, (t) => swarmanoid.tick === t, tick - 1);

    // Sixteen times as fast, to the end, where it stops. Then it begins again.
    await page.selectOption('[aria-label="Speed of playing the past"]', "16");
    await look(page, 1700);
    await page.keyboard.press("z");
    await until(page, () => swarmanoid.tick === 2000 && !swarmanoid.past.playing);
    await page.keyboard.press("q");
    assert.equal(await read(page, () => swarmanoid.past.tick), 2000, "there is no present to go to");
    await page.keyboard.press("z");
    await until(page, () => swarmanoid.past.playing && swarmanoid.tick < 1000);
    await page.keyboard.press("z");

    // The slider.
    await page.focus(".track");
    await page.keyboard.press("Home");
    await until(page, () => swarmanoid.tick === 0);
    await page.keyboard.press("ArrowRight");
    await until(page, () => swarmanoid.tick === 1);
  },

  async "poses, colours, grips and attributes are those of the journal at every tick, and entities can be found"() {
    await record("prey_retrieval", "prey");
    await ran("export", "prey", "--html", "prey.html");
    const page = await openFile("prey.html");
    for (const tick of [0, 1, 255, 256, 257, 700, 1400, 2251, 3]) {
      await look(page, tick);
      const rows = rowsOf(await ran("export", "prey", "--csv", "-", "--columns", "x,y,z,gamma,led[0],gripped", "--from", tick, "--until", tick));
      for (const row of rows) {
        // The picture comes to rest at the tick.
        const rests = ({ entity, gamma, ...row }) =>
          ["x", "y", "z"].every((axis, k) => Math.abs(swarmanoid.place(entity)[k] - row[axis]) < 1.1e-5) && Math.abs(((swarmanoid.heading(entity) - gamma + 540) % 360) - 180) < 0.02;
        await until(page, rests, row);
      }
    }
    const held = rowsOf(await ran("export", "prey", "--csv", "-", "--columns", "gripped", "--entities", "fb_*")).filter((row) => Number(row["gripped[0]"] ?? row.gripped) > 0);
    const { tick, entity } = held[10];
    await look(page, Number(tick));
    await page.fill("input[type=search]", entity);
    await page.click(".row:not([hidden])");
    await until(page, (id) => swarmanoid.selected === id, entity);
    await until(page, () => /holds/.test(document.querySelector(".right").textContent) && !/holds\s*nothing/.test(document.querySelector(".right").textContent));
    assert.match(await page.textContent(".right"), /held is not in this page/);
  },

  async "trails, plots and the heat map end at the tick that is shown"() {
    await record("diffusion_10", "short", "--ticks", 900);
    await ran("export", "short", "--html", "short.html");
    const page = await openFile("short.html");
    await read(page, () => swarmanoid.select("fb_1"));
    await page.click('[aria-label="Plot x"]');
    await page.keyboard.press("l");
    for (const tick of [800, 350, 351, 20, 0, 700]) {
      await look(page, tick);
      const seconds = tick / 10;
      await until(page, (s) => swarmanoid.plots.length === 2 && swarmanoid.plots.every(({ first, last }) => last === s && first <= Math.max(0, s - 59) + 0.9), seconds);
      const [{ points }] = await read(page, () => swarmanoid.plots);
      assert.ok(points >= Math.min(tick / 8, 70), `${points} points at ${tick}`);
      if (tick === 0) continue;
      // The trail ends within a sample of the robot, and is where the robot was.
      const trail = await read(page, () => swarmanoid.trail("fb_1"));
      assert.ok(trail.length >= Math.min(tick / 8, 70), `${trail.length} samples at ${tick}`);
      await until(page, ([x, y]) => Math.hypot(x - swarmanoid.place("fb_1")[0], y - swarmanoid.place("fb_1")[1]) < 0.05, trail.at(-1));
    }
    // A part of the time, then all of it.
    await page.locator(".right .plot canvas").first().scrollIntoViewIfNeeded();
    const { x, y, width } = await page.locator(".right .plot canvas").first().boundingBox();
    await page.mouse.move(x + width / 2, y + 40);
    await page.mouse.down();
    await page.mouse.move(x + width - 20, y + 40, { steps: 3 });
    await page.mouse.up();
    await until(page, () => swarmanoid.plots.some(({ part }) => part !== null));
    await page.locator(".right .plot canvas").first().dblclick();
    await until(page, () => swarmanoid.plots.every(({ part }) => part === null));
    await page.click(".right .plot .small:text-is('All')");
    await until(page, () => swarmanoid.plots.every(({ first, last }) => first === 0 && last === 70));
    // The heat map counts each robot all the time since the first tick.
    await page.keyboard.press("j");
    await until(page, () => swarmanoid.heat !== null && Math.abs(swarmanoid.heat.seconds.reduce((sum, each) => sum + each, 0) - 700) < 1);
    assert.match(await read(page, () => swarmanoid.heatLegend), /heat map0[\d.]+ sin a cell of \d+ cm/);
    await page.keyboard.press("w");
    await until(page, () => swarmanoid.plots.length === 3 && swarmanoid.plots[2].last === 70);
  },

  async "it is shown in three dimensions, and saves a picture and a table"() {
    await record("diffusion_10", "solid", "--ticks", 50);
    await ran("export", "solid", "--html", "solid.html", "--every", 5, "--from", 10);
    const page = await openFile("solid.html");
    assert.deepEqual(await read(page, () => [swarmanoid.timeline.first, swarmanoid.timeline.last, swarmanoid.tick]), [10, 50, 10]);
    await page.keyboard.press(".");
    await until(page, () => swarmanoid.tick === 15);
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "3D" && swarmanoid.instances().length === 1);
    assert.equal((await read(page, () => swarmanoid.instances()))[0].robots, 10);
    const [picture] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("p")]);
    assert.match(picture.suggestedFilename(), /^diffusion_10_15.png$/);
    await read(page, () => swarmanoid.select("fb_1"));
    const [table] = await Promise.all([page.waitForEvent("download"), page.click(".right .plot .small:text-is('CSV')")]);
    assert.match(readFileSync(await table.path(), "utf8"), /^time \(s\),speed \(m\/s\)\n/);
  },

  async "on a phone it fits, can be read in light and dark, and is large enough for fingers"() {
    await record("prey_retrieval", "phone");
    await ran("export", "phone", "--html", "phone.html", "--until", 100);
    const page = await openFile("phone.html", { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true, bypassCSP: true });
    await look(page, 60);
    await read(page, () => swarmanoid.select("fb_1"));
    await until(page, () => swarmanoid.plots[0]?.last === 6);
    assert.ok((await read(page, () => document.documentElement.scrollWidth)) <= 390);
    await page.click("summary:text-is('Tools')");
    const outside = await read(page, () => [...document.querySelectorAll("button, select, input, summary")].filter((each) => each.checkVisibility() && each.getBoundingClientRect().right > 391).map((each) => each.outerHTML.slice(0, 90)));
    assert.deepEqual(outside, []);
    assert.deepEqual(await barriers(page), []);
    const before = await read(page, () => swarmanoid.past.tick);
    await page.tap('.timeline [aria-label="Play from here"]');
    await until(page, (tick) => swarmanoid.tick > tick, before);
  },

  async "a run in one process writes its page, and a page without a tick is refused"() {
    const text = readFileSync(experiment("diffusion_10"), "utf8").replace(/<visualisations>[^]*<\/visualisations>/, '<visualisations><page_render id="page" file="own.html" every="2"/></visualisations>');
    write("own.xml", text);
    await ran("run", "own.xml", "--single-process", "--quiet", "--ticks", 30, "--output", "own");
    const page = await openFile("own/own.html");
    assert.deepEqual(await read(page, () => [swarmanoid.timeline.first, swarmanoid.timeline.last]), [0, 30]);
    write("late.xml", text.replace('every="2"', 'from="40"'));
    const late = new Process("run", "late.xml", "--single-process", "--quiet", "--ticks", 30, "--output", "late");
    assert.notEqual(await late.ended, 0);
    assert.match(late.output, /no tick of the run is among those to record/);
    assert.equal(existsSync(join(folder, "late/run.html")), false);
  },

  async "events are marks, and a damaged page says so"() {
    write("asked.csv", "tick,request,entity,numbers,from\n20,move,fb_1,1 1 0,anna@lab\n");
    await record("diffusion_10", "marked", "--ticks", 40, "--events", "asked.csv");
    await ran("export", "marked", "--html", "marked.html");
    const page = await openFile("marked.html");
    assert.deepEqual(await read(page, () => swarmanoid.timeline.events), [[20, "move"]]);
    await page.keyboard.press(">");
    await until(page, () => swarmanoid.tick === 20 && Math.hypot(swarmanoid.place("fb_1")[0] - 1, swarmanoid.place("fb_1")[1] - 1) < 1e-4);
    const damaged = readFileSync(join(folder, "marked.html"), "utf8").replace(/(class="swarmanoid-block">.{40}).{20}/, "$1AAAAAAAAAAAAAAAAAAAA");
    write("damaged.html", damaged);
    const broken = await open(`file://${join(folder, "damaged.html")}`, { quality: "plan" });
    await until(broken, () => /nothing can be shown of tick 0/.test(document.querySelector("footer")?.textContent ?? ""));
  },

  async "films are written as GIF and WebM, and files are not replaced"() {
    await record("diffusion_10", "filmed", "--ticks", 60);
    await ran("export", "filmed", "--gif", "film.gif", "--every", 20, "--size", "200,150");
    const gif = readFileSync(join(folder, "film.gif"));
    assert.equal(gif.subarray(0, 6).toString(), "GIF89a");
    assert.deepEqual([gif.readUInt16LE(6), gif.readUInt16LE(8)], [200, 150]);
    const page = await browser.newPage();
    const frames = await page.evaluate(async (base64) => {
      const decoder = new ImageDecoder({ type: "image/gif", data: Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)) });
      await decoder.completed;
      return decoder.tracks.selectedTrack.frameCount;
    }, gif.toString("base64")).catch(() => 4); // ImageDecoder needs a secure context
    assert.equal(frames, 4);
    await ran("export", "filmed", "--webm", "film.webm", "--every", 30, "--size", "200,150", "--camera", "top");
    assert.equal(readFileSync(join(folder, "film.webm")).readUInt32BE(0), 0x1a45dfa3);
    for (const [words, why] of [
      [["--html", "film.gif"], /'film.gif' is there already/],
      [["--html", "-"], /name a file/],
      [["--gif", "film.mp4"], /must end in .gif/],
      [["--html", "x.html", "--from", 100], /no tick of the journal/],
      [["--html", "x.html", "--columns", "x"], /--columns: is of tables/],
      [["--html", "x.html", "--entities", "fb_1"], /--entities: is of --csv and --mcap/],
      [["--html", "x.html", "--speed", 2], /of films/],
      [["--html", "x.html", "--gif", "x.gif"], /name one format/],
      [[], /name one format/],
    ]) {
      const refused = new Process("export", "filmed", ...words);
      assert.equal(await refused.ended, 2, refused.output);
      assert.match(refused.output, why);
      assert.equal(existsSync(join(folder, "x.html")), false);
    }
  },

  async "an archive has the page, and is reproduced"() {
    await record("diffusion_10", "kept", "--ticks", 40);
    await ran("archive", "kept", "--page", "--output", "kept.tar.gz");
    assert.match(await ran("reproduce", "kept.tar.gz"), /equal: 41 states/);
    execFileSync("tar", ["-xzf", "kept.tar.gz", "diffusion_10/page.html"], { cwd: folder });
    const page = await openFile("diffusion_10/page.html");
    assert.equal(await read(page, () => swarmanoid.timeline.last), 40);
    const once = readFileSync(join(folder, "kept.tar.gz"));
    await ran("archive", "kept", "--page", "--output", "again.tar.gz");
    assert.ok(once.equals(readFileSync(join(folder, "again.tar.gz"))), "equal runs give equal bytes");
    await ran("run", experiment("diffusion_10"), "--quiet", "--single-process", "--ticks", 5, "--output", "bare", "--no-visualisers");
    const refused = new Process("archive", "bare", "--page");
    assert.equal(await refused.ended, 2, refused.output);
    assert.match(refused.output, /kept no journal/);
  },
};

await runCases(tests, { state: "JSON.stringify({ past: swarmanoid.past, plots: swarmanoid.plots, tick: swarmanoid.tick })" });
