// The page of web_render in headless Chromium, on real runs of the command. Waits for the state of the page, never for
// pictures a second: rendering in software is slow. Ends with 77 if there is no browser.
//
// Environment: see harness.mjs.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { barriers, browser, experiment, folder, freePort, open, pixelsOf, Process, read, runCases, settled, textOf, TIMEOUT_MS, until, write } from "./harness.mjs";

const { SWARMANOID_CONFIGS } = process.env;

const run = (name, ...more) => new Process("run", experiment(name), "--quiet", ...more);
async function attach(...words) {
  const viewer = new Process("attach", "web", ...words);
  const [, url] = await viewer.says(/web_render: (http\S+)/);
  return { viewer, url };
}

// The first picture, with the camera at rest.
async function drawn(page) {
  await until(page, () => window.swarmanoid?.drawn > 0);
  await settled(page);
}
async function drawnPage(url, options) {
  const page = await open(url, options);
  await drawn(page);
  return page;
}
const tickOf = (page) => read(page, () => swarmanoid.tick);

// Red, green and blue (0 to 255) of the picture in a square of 2 `half` + 1 CSS pixels about a place of the page, row by row.
async function pixelsAbout(page, { x, y }, half) {
  const side = 2 * half + 1;
  return pixelsOf(page, await page.screenshot({ clip: { x: Math.round(x) - half, y: Math.round(y) - half, width: side, height: side } }));
}
// A check of pixels, made again until it passes: on a busy machine a screenshot may show a frame in which the browser has
// not put the picture yet, and is white there.
async function shows(check) {
  for (const deadline = Date.now() + TIMEOUT_MS; ; await new Promise((done) => setTimeout(done, 100)))
    try {
      return await check();
    } catch (error) {
      if (!(error instanceof assert.AssertionError) || Date.now() > deadline) throw error;
    }
}
const brightness = ([r, g, b]) => (r + g + b) / 3;
// WCAG asks for a contrast of 3:1 of graphical objects.
const contrast = (lighter, darker) => ((lighter / 255) ** 2.2 + 0.05) / ((darker / 255) ** 2.2 + 0.05);
const saturation = (colour) => Math.max(...colour) - Math.min(...colour);

// One robot that stands still in a walled square of ten metres.
function oneRobot(name, at) {
  const text = textOf("diffusion_100")
    .replace(/<distribute[^]*<\/distribute>/, `<footbot id="fb"><position>${at}</position><orientation>0, 0, 0</orientation><controller>diffusion</controller></footbot>`)
    .replace(/<visualisations>[^]*<\/visualisations>/, "");
  write(`${name}.xml`, text);
  return new Process("run", `${name}.xml`, "--quiet", "--paused", "--ticks", 0);
}

// The tick stays as it is for a while.
async function assertStill(page) {
  await page.waitForTimeout(300);
  const tick = await tickOf(page);
  await page.waitForTimeout(700);
  assert.equal(await tickOf(page), tick);
  return tick;
}

// ---- tests ----

const tests = {
  async "robots are drawn, picked, listed and filtered, with a clean console"() {
    run("prey_retrieval", "--real-time", 1);
    const { url } = await attach();
    assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/$/);
    const page = await drawnPage(url);
    assert.equal(await read(page, () => swarmanoid.experiment), "prey_retrieval");
    assert.equal(await read(page, () => swarmanoid.robots), 4);
    const instances = await read(page, () => swarmanoid.instances());
    assert.deepEqual(instances.map(({ robots }) => robots).sort(), [1, 3]);
    assert.deepEqual(instances.map(({ drawn: counts }) => counts.reduce((a, b) => a + b)).sort(), [1, 3]);

    // It drives on while the mouse is on its way: on a busy machine another click may be needed.
    for (let clicks = 0; clicks < 50 && (await read(page, () => swarmanoid.selected)) !== "fb_3"; clicks++) {
      const { x, y } = await read(page, () => swarmanoid.project("fb_3"));
      await page.mouse.click(x, y);
    }
    assert.equal(await read(page, () => swarmanoid.selected), "fb_3");
    await until(page, () => document.querySelector(".right h2")?.textContent === "fb_3");
    await until(page, () => document.querySelector(".right").textContent.includes("gripper aperture"));
    await page.waitForSelector(".right .plot canvas");

    assert.equal(await read(page, () => swarmanoid.shown), 11);
    assert.deepEqual(await read(page, () => [...document.querySelectorAll(".row .id")].filter((id) => id.scrollWidth > id.clientWidth).map((id) => id.textContent)), [], "ids that are cut");
    await page.fill("input[type=search]", "engine:sky");
    assert.equal(await read(page, () => swarmanoid.shown), 1);
    await page.fill("input[type=search]", "foot fb_2");
    await page.click(".row:not([hidden])");
    assert.equal(await read(page, () => swarmanoid.selected), "fb_2");
    await page.keyboard.press("Escape");

    for (const key of ["i", "l", "s", "End", "Home", "g"]) await page.keyboard.press(key);
    const now = await read(page, () => swarmanoid.drawn);
    await until(page, (before) => swarmanoid.drawn > before + 5, now);
    await page.keyboard.press("?");
    await page.waitForSelector(".help:not([hidden])");
    await page.keyboard.press("F1");
    await page.waitForSelector(".help", { state: "hidden" });
    const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("p")]);
    assert.match(saved.suggestedFilename(), /^prey_retrieval_\d+\.png$/);
    const png = readFileSync(await saved.path());
    assert.equal(png.toString("latin1", 1, 4), "PNG");
    const canvas = await read(page, () => [document.querySelector(".picture:not([hidden])").width, document.querySelector(".picture:not([hidden])").height]);
    assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], canvas);
    await until(page, () => swarmanoid.tick > 20);
  },

  async "who is not in the arena is listed as absent, and drawn once he comes"() {
    run("prey_supply", "--paused", "--ticks", 0, "--no-visualisers");
    const { url } = await attach();
    const page = await drawnPage(url);
    const absent = () => [...document.querySelectorAll(".row.absent:not([hidden]) .id")].map((id) => id.textContent).sort();
    await page.fill("input[type=search]", "late");
    await until(page, () => document.querySelectorAll(".row.absent:not([hidden])").length === 2);
    assert.deepEqual(await read(page, absent), ["late_0", "late_1"]);
    assert.deepEqual(await read(page, () => swarmanoid.place("late_0")), []);
    const robots = () => swarmanoid.instances().flatMap(({ drawn: counts }) => counts).reduce((a, b) => a + b);
    assert.equal(await read(page, robots), 3);
    // Nothing follows him to where he waits, a hundred kilometres away; his panel leaves less room for the arena.
    await read(page, () => swarmanoid.approach("late_0"));
    await drawn(page);
    const camera = await read(page, () => swarmanoid.camera);
    assert.ok(Math.hypot(...camera) < 20, camera);

    await new Process("control", "add", "late", "2.5,2.2,0").says(/added 'late_0'/);
    await until(page, () => Math.hypot(swarmanoid.place("late_0")[0] - 2.5, swarmanoid.place("late_0")[1] - 2.2) < 1e-6);
    await until(page, () => document.querySelectorAll(".row.absent:not([hidden])").length === 1);
    assert.deepEqual(await read(page, absent), ["late_1"]);
    await until(page, () => swarmanoid.instances().flatMap(({ drawn: counts }) => counts).reduce((a, b) => a + b) === 4);
    await new Process("control", "remove", "late_0").says(/removed 'late_0'/);
    await until(page, () => swarmanoid.place("late_0").length === 0);
  },

  async "a click on the floor adds an entity of a reserve, and the run says why one does not fit"() {
    run("prey_supply", "--paused", "--ticks", 0, "--no-visualisers", "--output", "added");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan", bypassCSP: true });
    await until(page, () => swarmanoid.adding?.options.some((text) => text === "footbot late (2 of 2 left)"));
    const click = async (x, y) => {
      await settled(page);
      const at = await page.evaluate(([a, b]) => swarmanoid.projectPoint(a, b, 0), [x, y]);
      await page.mouse.click(at.x, at.y);
    };
    await page.selectOption(".palette select", "late");
    await until(page, () => swarmanoid.adding.said === "click on the floor (Esc ends)");
    await click(2.5, 2.2);
    await until(page, () => /^added 'late_0' at tick 0$/.test(swarmanoid.adding.said));
    await until(page, () => Math.hypot(swarmanoid.place("late_0")[0] - 2.5, swarmanoid.place("late_0")[1] - 2.2) < 0.03);
    await until(page, () => swarmanoid.adding.options.includes("footbot late (1 of 2 left)"));
    await click(2.52, 2.2);
    await until(page, () => /^add: 'late_1' does not fit at 2\.5.*: the footbot 'late_0' stands there, at .*; choose a free place$/.test(swarmanoid.adding.said));
    assert.deepEqual(await barriers(page), []);
    await click(0.5, 0.4);
    await until(page, () => swarmanoid.place("late_1").length > 0);
    await click(0.5, 1.4);
    await until(page, () => /^add: all 2 entities of the reserve 'late' are in the arena; give its <reserve> \(line \d+\) a larger quantity$/.test(swarmanoid.adding.said));
    assert.equal(await read(page, () => swarmanoid.adding.chosen), "late");
    await page.keyboard.press("Escape");
    assert.equal(await read(page, () => swarmanoid.adding.chosen), null);
    await click(2.5, 2.2);
    await until(page, () => swarmanoid.selected === "late_0");
    // An entity that was taken out of the arena is offered, too.
    await read(page, () => swarmanoid.select("fb_0"));
    await page.keyboard.press("Delete");
    await until(page, () => swarmanoid.adding.options.includes("fb_0 (removed)"));
    await page.selectOption(".palette select", "fb_0");
    await click(0.5, 2.3);
    await until(page, () => Math.hypot(swarmanoid.place("fb_0")[0] - 0.5, swarmanoid.place("fb_0")[1] - 2.3) < 0.03);
    await until(page, () => swarmanoid.adding.chosen === null && !swarmanoid.adding.options.includes("fb_0 (removed)"));
    const events = readFileSync(join(folder, "added/events.csv"), "utf8");
    assert.match(events, /add.*late_0/);

    // A page without the token has no such choice.
    const bare = await drawnPage(url.split("#")[0], { quality: "plan" });
    await until(bare, () => swarmanoid.control === "token needed");
    await bare.waitForTimeout(600);
    assert.equal(await read(bare, () => swarmanoid.adding), null);
  },

  async "moves and removals by this page are undone and done again"() {
    run("prey_supply", "--paused", "--ticks", 0, "--no-visualisers");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan", bypassCSP: true });
    await until(page, () => swarmanoid.control === "granted");
    await settled(page, "fb_1");
    const first = await read(page, () => [...swarmanoid.place("fb_1"), swarmanoid.heading("fb_1")]);
    const near = (wanted) => until(page, ([x, y, , heading]) => {
      const [px, py] = swarmanoid.place("fb_1");
      const turn = Math.abs(((swarmanoid.heading("fb_1") - heading + 540) % 360) - 180);
      return Math.hypot(px - x, py - y) < 1e-3 && turn < 0.1;
    }, wanted);
    const state = (done, undone) => until(page, ([a, b]) => swarmanoid.moves.done === a && swarmanoid.moves.undone === b && swarmanoid.moves.waiting === 0, [done, undone]);
    await state(0, 0);
    assert.ok(await page.isDisabled('.tools button:has-text("Undo move")'));
    const [from, to] = [await read(page, () => swarmanoid.project("fb_1")), await read(page, () => swarmanoid.projectPoint(0.4, 0.4, 0))];
    await page.keyboard.down("Shift");
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, to.y);
    await page.mouse.wheel(0, 100);
    await page.mouse.move(to.x, to.y);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await state(1, 0);
    await until(page, () => Math.hypot(swarmanoid.place("fb_1")[0] - 0.4, swarmanoid.place("fb_1")[1] - 0.4) < 0.1);
    const second = await read(page, () => [...swarmanoid.place("fb_1"), swarmanoid.heading("fb_1")]);
    await page.keyboard.press("Control+z");
    await state(0, 1);
    await near(first);
    await page.keyboard.press("Control+y");
    await state(1, 0);
    await near(second);
    // A removal, undone by the button.
    await read(page, () => swarmanoid.select("fb_1"));
    await page.keyboard.press("Delete");
    await until(page, () => swarmanoid.place("fb_1").length === 0);
    await state(2, 0);
    await page.click(".tools summary");
    assert.deepEqual(await barriers(page), []);
    await page.click('.tools button:has-text("Undo move")');
    await near(second);
    await state(1, 1);
    // What the run refuses is no step.
    await read(page, () => swarmanoid.select("fb_1"));
    await page.click(".place summary");
    await page.fill(".place-form [name=x]", "50");
    await page.click('.place-form button:has-text("Move")');
    await page.waitForSelector(".last:has-text('outside the arena')");
    await state(1, 0);
    await near(second);
  },

  async "with the token the run is paused, stepped, resumed, and robots are moved"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const { url } = await attach("--allow-control");
    assert.match(url, /#token=[0-9a-f]{32}$/);
    const page = await drawnPage(url);
    await until(page, () => swarmanoid.control === "granted");
    await until(page, () => swarmanoid.phase === "running");
    await page.click("header .controls button >> nth=0");
    await until(page, () => swarmanoid.phase === "paused");
    const tick = await assertStill(page);
    await page.keyboard.press("n");
    await until(page, (before) => swarmanoid.tick === before + 1, tick);
    await page.keyboard.press("N");
    await until(page, (before) => swarmanoid.tick === before + 11, tick);
    // Robots have driven about, so the place is one that is free now, and so is the way's middle from fb_5 to it, with fb_3 there.
    const free = await read(page, () => {
      const places = [...Array(10).keys()].map((robot) => swarmanoid.place(`fb_${robot}`));
      const isFree = (x, y, but) => places.every((place, robot) => robot === but || Math.hypot(place[0] - x, place[1] - y) > 0.3);
      for (let x = 0.4; x < 2.8; x += 0.2)
        for (let y = 0.4; y < 2.8; y += 0.2)
          if (isFree(x, y, 3) && Math.hypot(places[5][0] - x, places[5][1] - y) > 0.7 && isFree((x + places[5][0]) / 2, (y + places[5][1]) / 2, 5)) return [x, y];
      return null;
    });
    await page.evaluate(([x, y]) => swarmanoid.command({ do: "move", entity: "fb_3", position: [x, y, 0], angles: [0, 0, 90] }), free);
    await until(page, ([x, y]) => Math.hypot(swarmanoid.place("fb_3")[0] - x, swarmanoid.place("fb_3")[1] - y) < 1e-6, free);

    // By hand: shift and drag.
    await settled(page, "fb_5");
    const [from, to] = await read(page, () => ["fb_5", "fb_3"].map((id) => swarmanoid.project(id)));
    const before = await read(page, () => swarmanoid.place("fb_5"));
    const apart = (place) => Math.hypot(place[0] - before[0], place[1] - before[1]);
    await page.keyboard.down("Shift");
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await until(page, ([x, y]) => Math.hypot(swarmanoid.place("fb_5")[0] - x, swarmanoid.place("fb_5")[1] - y) > 0.05, before);
    assert.ok(apart(await read(page, () => swarmanoid.place("fb_5"))) < 3);
    await until(page, () => document.querySelector("footer").textContent.includes("moved 'fb_5'"));

    await page.keyboard.press(" ");
    await until(page, (last) => swarmanoid.tick > last + 3, tick);
    await page.keyboard.press("f");
    assert.equal(await read(page, () => swarmanoid.followed), "fb_5");
    const camera = await read(page, () => swarmanoid.camera);
    await until(page, ([x, y]) => Math.hypot(swarmanoid.camera[0] - x, swarmanoid.camera[1] - y) > 0.02, camera);
  },

  async "without the token nothing is steered, though everything is seen"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const { url } = await attach("allow_control=true");
    const page = await drawnPage(url.replace(/#.*/, ""));
    assert.equal(await read(page, () => swarmanoid.control), "token needed");
    assert.ok(await page.isDisabled("header .controls button >> nth=0"));
    await read(page, () => swarmanoid.command({ do: "pause" }));
    await until(page, () => document.querySelector("footer").textContent.includes("only the address with the token"));
    const before = await tickOf(page);
    await until(page, (tick) => swarmanoid.tick > tick + 5, before);

    const wrong = await drawnPage(url.replace(/token=.{8}/, "token=00000000"));
    await until(wrong, () => swarmanoid.control === "wrong token");
    await read(wrong, () => swarmanoid.command({ do: "stop" }));
    await until(wrong, () => document.querySelector("footer").textContent.includes("only the address with the token"));
  },

  async "the page comes back when the server does"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const port = await freePort();
    const first = await attach(`port=${port}`);
    const page = await drawnPage(first.url, { noise: [/ERR_CONNECTION_REFUSED/] });
    await read(page, () => swarmanoid.select("fb_4"));
    await first.viewer.end("SIGKILL");
    await until(page, () => !swarmanoid.connected);
    await page.waitForSelector(".banner", { state: "visible" });
    const before = await tickOf(page);
    await attach(`port=${port}`);
    await until(page, (tick) => swarmanoid.connected && swarmanoid.tick > tick, before);
    assert.equal(await read(page, () => swarmanoid.selected), "fb_4");
    await page.waitForSelector(".banner", { state: "hidden" });
  },

  async "a page goes on with the next run of its experiment, at the same address with the same token"() {
    const first = run("diffusion_10", "--paused", "--ticks", 20);
    const { viewer, url } = await attach("--allow-control", "--linger", 0);
    const page = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/], quality: "plan" });
    await read(page, () => swarmanoid.select("fb_4"));
    const place = await read(page, () => swarmanoid.viewpoint);
    await page.keyboard.press(" ");
    assert.equal(await first.ended, 0);
    await viewer.ended;
    await until(page, () => !swarmanoid.connected);
    await until(page, () => /Start the experiment again/.test(document.querySelector(".banner").textContent));

    // The word in the banner lasts some seconds: all that it says is kept.
    await read(page, () => {
      window.banners = [];
      const banner = document.querySelector(".banner");
      new MutationObserver(() => banners.push(banner.textContent)).observe(banner, { childList: true, characterData: true, subtree: true });
    });
    // The viewer may come before the run.
    const waiting = new Process("attach", "web", "diffusion_10", "--allow-control");
    await waiting.says(/no experiment 'diffusion_10' runs on this machine yet; waiting 60 s/);
    run("diffusion_10", "--paused", "--ticks", 0);
    const [, again] = await waiting.says(/web_render: (http\S+)/);
    assert.equal(again, url);
    await until(page, () => swarmanoid.connected && swarmanoid.tick === 0);
    await until(page, () => banners.some((text) => /started again/.test(text)));
    await until(page, () => swarmanoid.control === "granted");
    assert.equal(await read(page, () => swarmanoid.selected), "fb_4");
    assert.deepEqual(await read(page, () => swarmanoid.viewpoint), place);
    await page.keyboard.press("n");
    await until(page, () => swarmanoid.tick === 1);
    // Another page of the same run has an address and a token of its own.
    const { url: other } = await attach("diffusion_10", "--allow-control");
    assert.notEqual(new URL(other).port, new URL(url).port);
    assert.notEqual(new URL(other).hash, new URL(url).hash);
  },

  async "what never starts is waited for only so long"() {
    const viewer = new Process("attach", "web", "nothing", "--wait", 0.5);
    assert.equal(await viewer.ended, 2);
    assert.match(viewer.output, /waiting 0.5 s[^]*no experiment runs on this machine/);
  },

  async "opened before the first tick and after the end of the run"() {
    const running = run("diffusion_10", "--paused", "--ticks", 50);
    const { viewer, url } = await attach("allow_control=true");
    const early = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/] });
    assert.equal(await read(early, () => swarmanoid.tick), 0);
    assert.equal(await read(early, () => swarmanoid.robots), 10);
    await read(early, () => swarmanoid.command({ do: "resume" }));
    assert.equal(await running.ended, 0);
    await until(early, () => swarmanoid.phase === "finished" && swarmanoid.tick === 50);

    const late = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/] });
    assert.equal(await read(late, () => swarmanoid.tick), 50);
    assert.equal(await read(late, () => swarmanoid.phase), "finished");
    assert.match(await late.textContent(".banner"), /The run has ended/);
    assert.equal(viewer.code, undefined);
    await viewer.end("SIGINT");
    await until(late, () => !swarmanoid.connected);
  },

  async "in an experiment file it lives as long as the run, in one process or several"() {
    const text = textOf("diffusion_10").replace(/<visualisations>[^]*<\/visualisations>/, "");
    const visualisation = '<visualisations><web_render id="page"><allow_control>true</allow_control></web_render></visualisations>';
    write("with_page.xml", text.replace("</ahss-config>", `${visualisation}</ahss-config>`));
    for (const more of [["--single-process"], []]) {
      const output = `page_${more.length}`;
      const running = new Process("run", "with_page.xml", "--quiet", "--real-time", 0.2, "--ticks", 200, "--output", output, ...more);
      const [, url] = await running.says(/web_render: (http\S+)/);
      const file = join(folder, output, existsSync(join(folder, output, "web_render.url")) ? "" : readdirSync(join(folder, output))[0], "web_render.url");
      assert.equal(readFileSync(file, "utf8").trim(), url);
      assert.equal(statSync(file).mode & 0o777, 0o600);
      const page = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/] });
      await until(page, () => swarmanoid.phase === "running" && swarmanoid.tick > 0);
      await page.keyboard.press(" ");
      await until(page, () => swarmanoid.phase === "paused");
      await assertStill(page);
      // So slow at first that the page is there in time on any machine.
      await page.selectOption("[aria-label=Speed]", "0");
      await page.locator(".controls button").first().click();
      assert.equal(await running.ended, 0);
      await until(page, () => !swarmanoid.connected && swarmanoid.tick === 200);
      await page.close();
    }
  },

  async "a reset begins the run again at tick 0, and the page goes on with it"() {
    const text = textOf("diffusion_10").replace(/<visualisations>[^]*<\/visualisations>/, "");
    const visualisation = '<visualisations><web_render id="page"><allow_control>true</allow_control></web_render></visualisations>';
    write("reset.xml", text.replace("</ahss-config>", `${visualisation}</ahss-config>`));
    for (const more of [["--single-process"], []]) {
      const output = `reset_${more.length}`;
      const running = new Process("run", "reset.xml", "--quiet", "--paused", "--ticks", 200, "--output", output, ...more);
      const [, url] = await running.says(/web_render: (http\S+)/);
      const page = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/], quality: "plan" });
      await until(page, () => swarmanoid.control === "granted");
      await read(page, () => swarmanoid.command({ do: "step", ticks: 7 }));
      await until(page, () => swarmanoid.tick === 7);
      page.once("dialog", (dialog) => dialog.accept());
      await page.locator("[aria-label='Begin again at tick 0']").click();
      const [, again] = await running.says(/web_render: http[^]*web_render: (http\S+)/);
      assert.equal(again, url);
      await until(page, () => swarmanoid.connected && swarmanoid.tick === 0 && swarmanoid.phase === "paused");
      await until(page, () => swarmanoid.control === "granted");
      assert.match(readFileSync(join(folder, output, "events.csv"), "utf8"), /^7,reset,1,/m);
      await read(page, () => swarmanoid.command({ do: "resume" }));
      assert.equal(await running.ended, 0);
      assert.equal(JSON.parse(readFileSync(join(folder, output, "reset-1/manifest.json"), "utf8")).ticks, 200);
      await page.close();
    }
  },

  async "the floor is as light without shadows as with them"() {
    oneRobot("bright", "5, 5, 0");
    const { url } = await attach();
    for (const quality of ["least", "low", "medium", "high"]) {
      const page = await drawnPage(url, { quality });
      const robot = await read(page, () => swarmanoid.project("fb"));
      await shows(async () => {
        const floor = await pixelsAbout(page, { x: robot.x - 60, y: robot.y }, 4);
        const mean = floor.reduce((sum, colour) => sum + brightness(colour), 0) / floor.length;
        assert.ok(mean > 195 && mean < 245, `quality ${quality}: ${mean}`);
      });
      await page.close();
    }
  },

  async "robots and objects are drawn as the meshes of files, in the colours of these"() {
    write(
      "meshes.xml",
      `<ahss-config>
        <framework><maxclock>100000</maxclock></framework>
        <entity_kinds><scout urdf="${join(SWARMANOID_CONFIGS, "urdf", "scout.urdf")}"/></entity_kinds>
        <arena size="2, 2, 1" optimization="2D">
          <cylindric_prey id="barrel" position="0.5, 1, 0" radius="0.2" height="0.4" colour="blue" mesh="${join(SWARMANOID_CONFIGS, "meshes", "barrel.obj")}"/>
          <block id="rock" position="1.5, 1, 0.2" size="0.4, 0.4, 0.4" colour="blue" mesh="${join(SWARMANOID_CONFIGS, "meshes", "rock.glb")}"/>
          <scout id="scout" position="1, 1, 0"/>
        </arena>
        <engines><dynamics2d id="floor"/></engines>
        <arena_physics><engine id="floor"><all/></engine></arena_physics>
        <visualisations><web_render id="page" camera_view_XYZ_0="1, 0.99, 3" camera_view_HPR_0="90, -89.9, 0"/></visualisations>
      </ahss-config>`,
    );
    const server = new Process("run", "meshes.xml", "--quiet", "--real-time", 1);
    const [, url] = await server.says(/web_render: (http\S+)/);
    const page = await drawnPage(url);
    const seenAt = async (id, half) => pixelsAbout(page, await read(page, `swarmanoid.project(${JSON.stringify(id)})`), half);
    const mean = (pixels) => [0, 1, 2].map((channel) => pixels.reduce((sum, pixel) => sum + pixel[channel], 0) / pixels.length);
    await shows(async () => {
      const barrel = mean(await seenAt("barrel", 3));
      assert.ok(barrel[0] > barrel[2] + 40, `the wood of the barrel is ${barrel}`);
      const rock = mean(await seenAt("rock", 3));
      assert.ok(saturation(rock) < 50 && brightness(rock) < 215, `the stone of the rock is ${rock}`);
      const hull = (await seenAt("scout", 14)).filter(([r, g, b]) => r > g + 40 && g > b + 20);
      assert.ok(hull.length > 20, `${hull.length} pixels of the scout are orange`);
    });
  },

  async "walls between the eye and the arena hide no robot"() {
    oneRobot("behind_wall", "5, 0.2, 0");
    const { url } = await attach();
    const page = await drawnPage(url);
    const [, y] = await read(page, () => swarmanoid.camera);
    assert.ok(y < 0, "the camera looks over the south wall");
    await shows(async () => {
      const seen = await pixelsAbout(page, await read(page, () => swarmanoid.project("fb")), 6);
      assert.ok(Math.max(...seen.map(saturation)) > 60, `walls are grey, robots are not: ${seen.slice(70, 90)}`);
    });
    // The one that hides nothing stands at its full height: 0.5 m above the floor's far edge is wall, not sky.
    const far = await read(page, () => swarmanoid.projectPoint(5, 10, 0.4));
    await shows(async () => {
      const wall = await pixelsAbout(page, far, 1);
      assert.ok(wall.every((colour) => brightness(colour) < 190 && saturation(colour) < 12), `${wall}`);
    });
  },

  async "without a graphics card the page begins with the plan, and loads nothing of the other view"() {
    oneRobot("planned", "5, 5, 0");
    const { url } = await attach();
    const page = await browser.newPage({ viewport: { width: 760, height: 420 } });
    const session = await page.context().newCDPSession(page);
    await session.send("Network.enable");
    let bytes = 0;
    session.on("Network.loadingFinished", ({ encodedDataLength }) => (bytes += encodedDataLength));
    const files = [];
    page.on("request", (request) => files.push(new URL(request.url()).pathname));
    await page.goto(url);
    await drawn(page);
    assert.equal(await read(page, () => swarmanoid.view), "plan");
    await page.waitForSelector(".plan-note", { state: "visible" });
    assert.deepEqual(files.filter((file) => /view_3d|meshes/.test(file)), []);
    assert.ok(bytes < 68000, `${bytes} bytes`);
    // Seen from above: dark tracks, the blue body, and the orange mark that tells the front, here to the right.
    const { x, y } = await read(page, () => swarmanoid.project("fb"));
    await read(page, () => swarmanoid.approach("fb"));
    await drawn(page);
    const near = await read(page, () => swarmanoid.project("fb"));
    const side = 101;
    await shows(async () => {
      const pixels = await pixelsAbout(page, near, 50);
      const orange = pixels.flatMap(([r, g, b], i) => (r > 200 && g > 100 && g < 190 && b < 120 ? [[(i % side) - 50, Math.floor(i / side) - 50]] : []));
      assert.ok(orange.length > 10, `${orange.length} orange pixels`);
      const mean = [0, 1].map((k) => orange.reduce((sum, place) => sum + place[k], 0) / orange.length);
      assert.ok(mean[0] > 5 && Math.abs(mean[1]) < 3, `the front is at ${mean}`);
      assert.ok(pixels.some(([r, g, b]) => b > r + 60), "the blue of a footbot");
    });
    assert.ok(Math.abs(x - 380) < 380 && y > 0);
    // And then all of it.
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "3D");
    await page.waitForLoadState("networkidle");
    // But for what shows drawings, of which this experiment has none.
    assert.deepEqual(files.filter((file) => /drawn/.test(file)), []);
    assert.ok(bytes > 100000 && bytes < 320000, `${bytes} bytes`);
  },

  async "plan and three dimensions show the same place, and keep what is selected and shown"() {
    run("prey_retrieval", "--real-time", 1);
    const { url } = await attach();
    const page = await drawnPage(url, { quality: "plan" });
    await read(page, () => swarmanoid.select("fb_2"));
    await page.keyboard.press("i");
    await page.keyboard.press("l");
    await drawn(page);
    await page.mouse.move(300, 200);
    await page.mouse.wheel(0, -300);
    await drawn(page);
    const before = await read(page, () => swarmanoid.viewpoint);
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "3D");
    const same = (a, b) => [...a.target.map((value, k) => value - b.target[k]), a.span - b.span].every((difference) => Math.abs(difference) < 1e-6);
    const solid = await read(page, () => swarmanoid.viewpoint);
    assert.ok(same(before, solid), JSON.stringify([before, solid]));
    assert.equal(await read(page, () => swarmanoid.selected), "fb_2");
    assert.equal(await page.getAttribute("header .toggle >> nth=0", "aria-pressed"), "true");
    await until(page, () => swarmanoid.instances().flatMap(({ drawn: counts }) => counts).reduce((a, b) => a + b) > 0);
    await page.click(".toggle:has-text('Plan')");
    await until(page, () => swarmanoid.view === "plan");
    assert.ok(same(before, await read(page, () => swarmanoid.viewpoint)));
    assert.equal(await read(page, () => swarmanoid.selected), "fb_2");
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "3D");
  },

  async "the plan is moved, zoomed, picked and selected in by hand, and robots are moved in it"() {
    run("diffusion_10", "--paused", "--ticks", 0);
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan" });
    const at = (id) => read(page, `swarmanoid.project("${id}")`);
    // What is under the pointer stays there while the wheel turns.
    const [from] = [await at("fb_3")];
    await page.mouse.move(from.x, from.y);
    await page.mouse.wheel(0, -400);
    await drawn(page);
    const zoomed = await at("fb_3");
    assert.ok(Math.hypot(zoomed.x - from.x, zoomed.y - from.y) < 1.5, JSON.stringify([from, zoomed]));
    await page.mouse.down();
    await page.mouse.move(from.x + 60, from.y + 30, { steps: 4 });
    await page.mouse.up();
    await drawn(page);
    const dragged = await at("fb_3");
    assert.ok(Math.hypot(dragged.x - from.x - 60, dragged.y - from.y - 30) < 2, JSON.stringify([from, dragged]));
    assert.equal(await read(page, () => swarmanoid.selected), null);
    await page.keyboard.press("ArrowRight");
    await drawn(page);
    assert.ok((await at("fb_3")).x < dragged.x - 20);

    await page.keyboard.press("Home");
    await drawn(page);
    const robot = await at("fb_5");
    await page.mouse.click(robot.x, robot.y);
    assert.equal(await read(page, () => swarmanoid.selected), "fb_5");
    await drawn(page);
    // The ring about it is blue.
    await shows(async () => {
      const ring = await pixelsAbout(page, await at("fb_5"), 30);
      assert.ok(ring.filter(([r, g, b]) => b > 200 && r < 120 && g < 180).length > 20);
    });

    // All of them, by a box; then two are moved as one.
    const box = await page.locator(".picture:not([hidden])").boundingBox();
    await page.keyboard.down("Shift");
    await page.mouse.move(box.x + 3, box.y + 3);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width - 3, box.y + box.height - 3, { steps: 4 });
    await page.mouse.up();
    assert.equal((await read(page, () => swarmanoid.chosen)).length, 10);
    const places = () => read(page, () => [0, 1, 2, 3, 4, 5, 6, 7, 8, 9].map((i) => swarmanoid.place(`fb_${i}`)));
    await drawn(page);
    const [before, start] = [await places(), await at("fb_0")];
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    await page.mouse.move(start.x + 8, start.y, { steps: 3 });
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await until(page, (x) => Math.abs(swarmanoid.place("fb_0")[0] - x) > 1e-3, before[0][0]);
    await until(page, (x) => Math.abs(swarmanoid.place("fb_9")[0] - x) > 1e-3, before[9][0]);
    // Each is moved by a request of its own.
    const moved = async () => (await places()).map((place, i) => place[0] - before[i][0]);
    const isWhole = (distances) => distances[0] > 0 && distances.every((distance) => Math.abs(distance - distances[0]) < 1e-3);
    for (const late = Date.now() + TIMEOUT_MS; !isWhole(await moved()) && Date.now() < late; ) await drawn(page);
    assert.ok(isWhole(await moved()), `${await moved()}`);
  },

  async "lengths are measured, and a robot is moved and turned by its handles, in both views"() {
    oneRobot("handled", "5, 5, 0");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan" });
    const point = (x, y) => read(page, `swarmanoid.projectPoint(${x}, ${y}, 0)`);
    const drag = async (from, to) => {
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 3 });
      await page.mouse.move(to.x, to.y, { steps: 3 });
      await page.mouse.up();
    };
    for (const view of ["plan", "3D"]) {
      if (view === "3D") await page.keyboard.press("v");
      await until(page, (name) => swarmanoid.view === name, view);
      await drawn(page);
      await page.keyboard.press("m");
      await drag(await point(4, 4), await point(7, 8));
      const { metres, degrees } = await read(page, () => swarmanoid.measured);
      assert.ok(Math.abs(metres - 5) < 0.1 && Math.abs(degrees - 53.13) < 1, `${view}: ${metres} m, ${degrees} degrees`);
      await page.keyboard.press("m");
      assert.equal(await read(page, () => swarmanoid.measured), null);

      await read(page, () => swarmanoid.approach("fb"));
      await page.keyboard.press("h");
      await drawn(page);
      const [x, y] = await read(page, () => swarmanoid.place("fb"));
      const { turn } = await read(page, () => swarmanoid.handles);
      // Its arrow to +y.
      await drag(turn, await point(x, y + 0.5));
      await until(page, () => Math.abs(swarmanoid.heading("fb") - 90) < 3);
      await until(page, ([a, b]) => Math.hypot(swarmanoid.place("fb")[0] - a, swarmanoid.place("fb")[1] - b) < 0.01, [x, y]);
      const { move } = await read(page, () => swarmanoid.handles);
      await drag(move, await point(x + 0.3, y));
      await until(page, ([a, b]) => Math.hypot(swarmanoid.place("fb")[0] - a - 0.3, swarmanoid.place("fb")[1] - b) < 0.03, [x, y]);
      // And back to where it looked, by the form: to the millimetre.
      await page.click(".place summary");
      for (const [name, value] of [["x", 5], ["y", 5], ["z", 0], ["heading", 0]]) await page.fill(`.place-form [name=${name}]`, String(value));
      await page.click(".place-form button[type=submit]");
      await until(page, () => Math.hypot(swarmanoid.place("fb")[0] - 5, swarmanoid.place("fb")[1] - 5) < 1e-5 && Math.abs(swarmanoid.heading("fb")) < 0.1);
      await page.keyboard.press("Escape");
      await page.keyboard.press("h");
      await page.keyboard.press("Home");
    }
  },

  async "robots are taken out of the arena and put in again"() {
    run("prey_supply", "--paused", "--ticks", 0, "--no-visualisers");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan", bypassCSP: true });
    await page.fill("input[type=search]", "late_0");
    await page.click(".row:not([hidden])");
    await page.click(".place summary");
    await until(page, () => document.querySelector(".place-form [type=submit]").textContent === "Add");
    for (const [name, value] of [["x", 2.5], ["y", 2.2], ["z", 0], ["heading", 45]]) await page.fill(`.place-form [name=${name}]`, String(value));
    await page.keyboard.press("Enter");
    await until(page, () => Math.hypot(swarmanoid.place("late_0")[0] - 2.5, swarmanoid.place("late_0")[1] - 2.2) < 1e-5);
    assert.ok(Math.abs((await read(page, () => swarmanoid.heading("late_0"))) - 45) < 0.1);
    await until(page, () => document.querySelector(".place-form [type=submit]").textContent === "Move");
    await page.click(".place-form button:has-text('Remove')");
    await until(page, () => swarmanoid.place("late_0").length === 0);
    await page.click(".place-form [type=submit]");
    await until(page, () => swarmanoid.place("late_0").length === 3);
    await page.focus("[role=listbox]");
    await page.keyboard.press("Delete");
    await until(page, () => swarmanoid.place("late_0").length === 0);

    // Who has no token has no form.
    const other = await drawnPage(url.replace(/#.*/, ""), { quality: "plan" });
    await read(other, () => swarmanoid.select("late_0"));
    await other.waitForSelector(".place", { state: "hidden" });
    await other.click(".tools summary");
    assert.ok(await other.isDisabled(".tools button:has-text('Handles')"));
  },

  async "values of one unit share a plot, which is saved as a table and as a picture"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const { url } = await attach();
    const page = await drawnPage(url, { quality: "plan", viewport: { width: 1000, height: 700 } });
    await read(page, () => swarmanoid.select("fb_4"));
    const plots = page.locator(".right .plot");
    assert.equal(await plots.count(), 1); // speed
    for (const name of ["x", "y", "heading"]) await page.click(`[aria-label="Plot ${name}"]`);
    assert.equal(await plots.count(), 3); // m/s, m, degrees
    const begin = await read(page, () => swarmanoid.tick); // plots have nothing of the time before they were opened
    await until(page, (tick) => swarmanoid.tick > tick + 30, begin);
    await page.click(".plot >> nth=1 >> text=All");
    const lines = [];
    // A busy machine shows few of the ticks.
    await shows(async () => {
      const [table] = await Promise.all([page.waitForEvent("download"), page.click(".plot >> nth=1 >> text=CSV")]);
      assert.equal(table.suggestedFilename(), "diffusion_10_fb_4_x_y.csv");
      lines.splice(0, Infinity, ...readFileSync(await table.path(), "utf8").trim().split("\n"));
      assert.ok(lines.length > 5, `${lines.length} lines`);
    });
    assert.equal(lines[0], "time (s),x (m),y (m)");
    const [x, y] = lines.at(-1).split(",").slice(1).map(Number);
    assert.ok(x > -0.2 && x < 3.4 && y > -0.2 && y < 3.4 && !lines.at(-1).includes("NaN"));
    const times = lines.slice(1).map((line) => Number(line.split(",")[0]));
    times.forEach((time, i) => assert.ok(i === 0 || time > times[i - 1]));
    const [image] = await Promise.all([page.waitForEvent("download"), page.click(".plot >> nth=1 >> text=PNG")]);
    assert.equal(readFileSync(await image.path()).toString("latin1", 1, 4), "PNG");
    await page.click(".plot >> nth=1 >> [aria-label=Close]");
    assert.equal(await plots.count(), 2);
    assert.equal(await page.locator(".plottable.plotted").count(), 2);

    // The swarm's mean, over all and over the selected robots.
    await page.keyboard.press("w");
    await page.click(".swarm button:has-text('distance from the middle')");
    await until(page, () => /mean and standard deviation of all 10 robots/.test(document.querySelector(".swarm").textContent));
    await until(page, () => /^distance from the middle [\d.]+ ± [\d.]+ m$/.test(document.querySelectorAll(".swarm .legend-names span")[2]?.textContent.trim() ?? ""));
    const [swarm] = await Promise.all([page.waitForEvent("download"), page.click(".swarm .plot >> nth=1 >> text=CSV")]);
    assert.match(readFileSync(await swarm.path(), "utf8"), /^time \(s\),distance from the middle \(m\),"distance from the middle, standard deviation \(m\)"\n/);
    await page.keyboard.press("w");
    assert.equal(await page.locator(".swarm").count(), 0);
  },

  async "robots are coloured by a value, and where they have been is shown, in both views"() {
    run("diffusion_10", "--real-time", 4, "--ticks", 100000);
    const { url } = await attach();
    for (const quality of ["plan", "low"]) {
      const page = await drawnPage(url, { quality });
      await page.click(".tools summary");
      await page.selectOption("[aria-label='Colours of robots']", "distance from the middle");
      await until(page, () => swarmanoid.colouring.high > swarmanoid.colouring.low);
      assert.match(await page.textContent(".legend"), /distance from the middle\s*[\d.]+ m/);
      // The one that is furthest is yellow, and no LED shines in this experiment.
      await page.click(".tools summary");
      await page.keyboard.press("j");
      await until(page, () => swarmanoid.heat?.drawn && swarmanoid.heat.seconds.reduce((a, b) => a + b) > 20);
      const { columns, rows } = await read(page, () => swarmanoid.heat);
      assert.equal(columns, rows);
      // The floor has a colour where robots have been before and are no longer; elsewhere it is grey. The robots drive on, and
      // the ramp grows with the longest stay: so the places are chosen again for each picture.
      await shows(async () => {
        const spots = await read(page, () => {
          const { columns: width, rows: height, seconds } = swarmanoid.heat;
          const middle = (i) => [((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height].map((part) => part * 3.16228);
          const away = (i) => Math.min(...[0, 1, 2, 3, 4, 5, 6, 7, 8, 9].map((n) => Math.hypot(...middle(i).map((value, k) => value - swarmanoid.place(`fb_${n}`)[k]))));
          // Not under the panels at the edges.
          const cells = [...seconds.keys()].filter((i) => middle(i).every((value) => Math.abs(value - 1.58114) < 0.9) && away(i) > 0.3);
          const longest = cells.reduce((best, i) => (best === undefined || seconds[i] > seconds[best] ? i : best), undefined);
          const never = cells.find((i) => [-width - 1, -width, 1 - width, -1, 0, 1, width - 1, width, width + 1].every((step) => !seconds[i + step]));
          if (longest === undefined || never === undefined || seconds[longest] === 0) return null;
          return [longest, never].map((i) => swarmanoid.projectPoint(...middle(i), 0));
        });
        assert.ok(spots, "robots have been, or are, everywhere");
        // The middle of the ramp is grey, too. A line of the floor differs from it by 25.
        const [there, elsewhere] = (await Promise.all(spots.map((at) => pixelsAbout(page, at, 0)))).map(([pixel]) => pixel);
        assert.ok(Math.max(...there.map((value, k) => Math.abs(value - elsewhere[k]))) > 35, `${quality}: ${there}, ${elsewhere}`);
      });
      await page.keyboard.press("j");
      assert.equal(await read(page, () => swarmanoid.heat), null);
      await page.close();
    }
  },

  async "the robot with the highest value has the last colour of the ramp"() {
    run("diffusion_10", "--paused", "--ticks", 0);
    const { url } = await attach();
    for (const quality of ["plan", "low"]) {
      const page = await drawnPage(url, { quality });
      await read(page, () => swarmanoid.colourBy("distance from the middle"));
      const id = await read(page, () => {
        const away = (n) => Math.hypot(...swarmanoid.place(`fb_${n}`).slice(0, 2).map((value) => value - 1.58114));
        return `fb_${[0, 1, 2, 3, 4, 5, 6, 7, 8, 9].sort((a, b) => away(b) - away(a))[0]}`;
      });
      await page.evaluate((name) => swarmanoid.approach(name), id);
      await drawn(page);
      await shows(async () => {
        const pixels = await pixelsAbout(page, await page.evaluate((name) => swarmanoid.project(name), id), 60);
        const yellow = pixels.filter(([r, g, b]) => r > 225 && g > 205 && b < 90);
        assert.ok(yellow.length > 15, `${quality}: ${yellow.length} yellow pixels about ${id}`);
      });
      await page.close();
    }
  },

  async "a link opens the same view and has no token, and the picture is filmed"() {
    run("diffusion_10", "--real-time", 1, "--ticks", 0);
    const { url } = await attach("--allow-control");
    const page = await open(url, { quality: "plan" });
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await drawn(page);
    await read(page, () => swarmanoid.approach("fb_7"));
    await read(page, () => swarmanoid.show("ids", true));
    await read(page, () => swarmanoid.colourBy("speed"));
    await page.keyboard.press("y");
    await until(page, () => swarmanoid.link !== null);
    const link = await read(page, () => swarmanoid.link);
    assert.ok(!link.includes("token") && link.startsWith(new URL(url).origin), link);
    await until(page, async () => (await navigator.clipboard.readText()) === swarmanoid.link);

    const other = await browser.newPage({ viewport: { width: 760, height: 420 } });
    await other.goto(link);
    await drawn(other);
    await until(other, () => swarmanoid.selected === "fb_7");
    const [a, b] = [await read(page, () => swarmanoid.viewpoint), await read(other, () => swarmanoid.viewpoint)];
    assert.ok(a.target.every((value, k) => Math.abs(value - b.target[k]) < 1e-3) && Math.abs(a.span - b.span) < 1e-3, JSON.stringify([a, b]));
    assert.equal(await other.getAttribute("header .toggle >> nth=0", "aria-pressed"), "true");
    assert.equal((await read(other, () => swarmanoid.colouring)).name, "speed");
    assert.equal(await read(other, () => swarmanoid.control), "token needed");
    await other.close();

    await page.keyboard.press("Shift+P");
    const before = await read(page, () => swarmanoid.drawn);
    await until(page, (count) => swarmanoid.drawn > count + 20, before);
    const [film] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Shift+P")]);
    assert.match(film.suggestedFilename(), /^diffusion_10_\d+\.(webm|mp4)$/);
    const bytes = readFileSync(await film.path());
    assert.ok(bytes.length > 5000, `${bytes.length} bytes`);
    if (film.suggestedFilename().endsWith("webm")) assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3); // EBML
  },

  async "the token is never sent, and leaves the address bar, but not the tab"() {
    run("diffusion_10", "--paused", "--ticks", 0);
    const { url } = await attach("--allow-control");
    const token = new URL(url).hash.slice("#token=".length);
    const page = await browser.newPage();
    page.setDefaultTimeout(TIMEOUT_MS);
    const sent = [];
    page.on("request", (request) => sent.push(request.url(), JSON.stringify(request.headers())));
    page.on("websocket", (socket) => {
      sent.push(socket.url());
      socket.on("framesent", ({ payload }) => sent.push(String(payload)));
    });
    await page.goto(url);
    await until(page, () => swarmanoid.control === "granted");
    assert.equal(page.url(), url.replace(/#.*/, ""));
    await page.reload();
    await until(page, () => swarmanoid.control === "granted");
    await page.keyboard.press("n");
    await until(page, () => swarmanoid.tick === 1);
    assert.ok(sent.some((text) => text.includes('"prove"')));
    assert.deepEqual(sent.filter((text) => text.includes(token)), []);
    // The answer of one connection is none for another.
    const proof = JSON.parse(sent.find((text) => text.includes('"prove"'))).proof;
    const thief = await drawnPage(url.replace(/#.*/, ""), { quality: "plan" });
    await thief.evaluate((text) => swarmanoid.command({ do: "prove", proof: text }), proof);
    await until(thief, () => swarmanoid.control === "wrong token");
    // By hand.
    thief.once("dialog", (dialog) => dialog.accept(url));
    await thief.click(".lock");
    await until(thief, () => swarmanoid.control === "granted");
  },

  async "rays end at what they meet, and bodies are those that the engines collide, in both views"() {
    // Two footbots face to face, 0.1 m apart, and a third away from everything.
    const text = textOf("diffusion_10")
      .replace(/<distribute[^]*<\/distribute>/, ["1.5, 1.5", "1.7, 1.5", "0.8, 0.8"].map((at, i) => `<footbot id="fb_${i}"><position>${at}, 0</position><orientation>0, 0, 0</orientation><controller>diffusion</controller></footbot>`).join(""))
      .replace(/<visualisations>[^]*<\/visualisations>/, "");
    write("rays.xml", text);
    new Process("run", "rays.xml", "--quiet", "--paused", "--ticks", 0);
    const { url } = await attach();
    for (const quality of ["plan", "low"]) {
      const page = await drawnPage(url, { quality });
      assert.deepEqual(await read(page, () => swarmanoid.marks), {});
      await page.keyboard.press("r");
      await page.keyboard.press("c");
      await until(page, () => swarmanoid.marks["rays that are free"] > 0 && swarmanoid.marks.bodies > 0);
      const { "rays that are free": free, "rays that meet something": hit, bodies } = await read(page, () => swarmanoid.marks);
      assert.equal(free + hit, 3 * 24);
      assert.ok(hit >= 4 && hit <= 16 && hit % 2 === 0, `${hit} rays meet something`);
      // A box has 12 edges, a cylinder two rims of 24 pieces and four lines between them: four walls, three footbots at least.
      assert.ok(bodies >= 4 * 12 + 3 * 52, `${bodies} lines`);
      // Red between the two, and none about the third.
      await read(page, () => swarmanoid.approach("fb_0"));
      await drawn(page);
      const between = await read(page, () => swarmanoid.projectPoint(1.6, 1.5, 0.06));
      const red = ([r, g, b]) => r > 150 && g < 120 && b < 120;
      await shows(async () => assert.ok((await pixelsAbout(page, between, 12)).filter(red).length > 8, quality));
      await page.keyboard.press("r");
      await page.keyboard.press("c");
      assert.deepEqual(await read(page, () => swarmanoid.marks), {});
      await page.close();
    }
  },

  async "viewpoints of the file are gone to, kept and flown through"() {
    const element = '<opengl_render id="w"><camera_view_XYZ_0>1, -1, 1.2</camera_view_XYZ_0><camera_view_HPR_0>80, -25, 0</camera_view_HPR_0><camera_view_XYZ_4>2.5, 1, 0.4</camera_view_XYZ_4><camera_view_HPR_4>-155, 0, 10</camera_view_HPR_4></opengl_render>';
    const text = textOf("diffusion_10").replace(/<visualisations>[^]*<\/visualisations>/, `<visualisations>${element}</visualisations>`);
    write("views.xml", text);
    new Process("run", "views.xml", "--quiet", "--paused", "--ticks", 0, "--no-visualisers");
    const { url } = await attach();
    const page = await open(url);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await drawn(page);
    const near = (a, b) => ["heading", "pitch"].every((name) => Math.abs(a[name] - b[name]) < 1e-3) && a.position.every((value, k) => Math.abs(value - b.position[k]) < 1e-4);
    const first = { position: [1, -1, 1.2], heading: 80, pitch: -25 };
    await page.keyboard.press("Control+0");
    assert.ok(near(await read(page, () => swarmanoid.standing), first), JSON.stringify(await read(page, () => swarmanoid.standing)));
    // It looks where the camera of a window would: at the floor 1.2 / tan 25 degrees ahead.
    const ahead = 1.2 / Math.tan((25 * Math.PI) / 180);
    const [x, y] = [1 + ahead * Math.cos((80 * Math.PI) / 180), -1 + ahead * Math.sin((80 * Math.PI) / 180)];
    const seen = await page.evaluate(([a, b]) => swarmanoid.projectPoint(a, b, 0), [x, y]);
    const box = await page.locator(".picture:not([hidden])").boundingBox();
    assert.ok(Math.hypot(seen.x - box.x - box.width / 2, seen.y - box.y - box.height / 2) < 1, JSON.stringify([seen, box]));
    // Level and leaning, as the hands never have it.
    await page.keyboard.press("Control+4");
    const level = await read(page, () => swarmanoid.standing);
    assert.ok(near(level, { position: [2.5, 1, 0.4], heading: -155, pitch: 0 }), JSON.stringify(level));
    const up = await read(page, () => [swarmanoid.projectPoint(0.6, 0.1, 0.2), swarmanoid.projectPoint(0.6, 0.1, 0.6)]);
    assert.ok(Math.abs((up[1].x - up[0].x) / (up[1].y - up[0].y) - Math.tan((10 * Math.PI) / 180)) < 0.02, JSON.stringify(up));

    await page.keyboard.press("Control+Shift+Digit2");
    const xml = "<camera_view_XYZ_2>2.5, 1, 0.4</camera_view_XYZ_2>\n<camera_view_HPR_2>-155, 0, 0</camera_view_HPR_2>";
    await until(page, async (wanted) => (await navigator.clipboard.readText()) === wanted, xml);
    await page.click(".tools summary");
    assert.deepEqual(await page.locator("[aria-label=Viewpoint] option").allTextContents(), ["…", "0", "2", "4"]);
    await page.selectOption("[aria-label=Viewpoint]", "0");
    assert.ok(near(await read(page, () => swarmanoid.standing), first));
    await page.click(".tools summary");
    // In the plan: what is looked at is in the middle.
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "plan");
    await page.keyboard.press("Control+0");
    const { target } = await read(page, () => swarmanoid.viewpoint);
    assert.ok(Math.hypot(target[0] - x, target[1] - y) < 1e-3, `${target}`);
    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "3D");

    await page.keyboard.press("u");
    await until(page, () => swarmanoid.flying);
    await until(page, () => !swarmanoid.flying);
    const end = await read(page, () => swarmanoid.standing);
    assert.ok(Math.hypot(...end.position.map((value, k) => value - [2.5, 1, 0.4][k])) < 0.3, JSON.stringify(end));
  },

  async "a page begins at the first viewpoint that it is given"() {
    oneRobot("begins", "5, 5, 0");
    const { url } = await attach("camera_view_XYZ_3=5,3,2", "camera_view_HPR_3=90,-45,0", "camera_view_XYZ_7=1,1,1");
    const page = await drawnPage(url);
    await until(page, () => Math.abs(swarmanoid.standing.pitch + 45) < 1e-3);
    const { position, heading } = await read(page, () => swarmanoid.standing);
    assert.ok(Math.abs(heading - 90) < 1e-3 && Math.hypot(position[0] - 5, position[1] - 3, position[2] - 2) < 1e-3, `${position}, ${heading}`);
    assert.deepEqual(await read(page, () => Object.keys(swarmanoid.viewpoints)), ["3", "7"]);
  },

  async "arrow keys, Ctrl and click and the wheel of a drag do what they do in the windows"() {
    run("diffusion_10", "--paused", "--ticks", 0);
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url);
    const direction = () => read(page, () => {
      const [x, y, z] = swarmanoid.viewpoint.direction;
      return { azimuth: (Math.atan2(y, x) * 180) / Math.PI, height: (Math.asin(z) * 180) / Math.PI };
    });
    const before = await direction();
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowUp");
    const after = await direction();
    assert.ok(Math.abs(after.azimuth - before.azimuth - 10) < 0.01 && Math.abs(after.height - before.height - 5) < 0.01, JSON.stringify([before, after]));

    await page.keyboard.press("v");
    await until(page, () => swarmanoid.view === "plan");
    await page.keyboard.press("Home");
    await drawn(page);
    for (const [id, modifiers] of [["fb_2", []], ["fb_6", ["Control"]]]) {
      const { x, y } = await read(page, `swarmanoid.project("${id}")`);
      for (const key of modifiers) await page.keyboard.down(key);
      await page.mouse.click(x, y);
      for (const key of modifiers) await page.keyboard.up(key);
      await drawn(page);
    }
    assert.deepEqual((await page.locator(".card h2").allTextContents()).sort(), ["fb_2", "fb_6"]);

    const heading = await read(page, () => swarmanoid.heading("fb_6"));
    const { x, y } = await read(page, () => swarmanoid.project("fb_6"));
    await page.keyboard.down("Shift");
    await page.mouse.move(x, y);
    await page.mouse.down();
    const { span } = await read(page, () => swarmanoid.viewpoint);
    for (let i = 0; i < 2; i++) await page.mouse.wheel(0, -100);
    await until(page, () => document.querySelector("main .labels:not([hidden])"));
    await page.waitForTimeout(200);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await until(page, (angle) => Math.abs(Math.abs(swarmanoid.heading("fb_6") - angle) % 360 - 15) < 0.5 || Math.abs(Math.abs(swarmanoid.heading("fb_6") - angle) - 345) < 0.5, heading);
    assert.equal((await read(page, () => swarmanoid.viewpoint)).span, span);
  },

  async "the camera rides on a robot and looks about"() {
    oneRobot("boarded", "5, 5, 0");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan" });
    await page.keyboard.press("o");
    assert.equal(await read(page, () => swarmanoid.aboard), null);
    await until(page, () => document.querySelector("footer").textContent.includes("select a robot first"));
    await read(page, () => swarmanoid.select("fb"));
    await page.keyboard.press("o");
    await until(page, () => swarmanoid.view === "3D" && swarmanoid.aboard === "fb");
    const away = (yaw) => Math.abs((((yaw + 180) % 360) + 360) % 360 - 180);
    for (const [x, y, angle] of [[3, 4, 35], [6, 2, -120]]) {
      await page.evaluate(([a, b, c]) => swarmanoid.command({ do: "move", entity: "fb", position: [a, b, 0], angles: [0, 0, c] }), [x, y, angle]);
      await until(page, ([a, b]) => Math.hypot(swarmanoid.camera[0] - a, swarmanoid.camera[1] - b) < 1e-3, [x, y]);
      await drawn(page);
      const { position, heading } = await read(page, () => swarmanoid.standing);
      assert.ok(away(heading - angle) < 0.5, `${heading} degrees`);
      assert.ok(position[2] > 0.14 && position[2] < 0.2, `${position}`);
    }
    const before = await read(page, () => swarmanoid.standing);
    const box = await page.locator(".picture:not([hidden])").boundingBox();
    await page.mouse.move(box.x + 200, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 300, box.y + 100, { steps: 4 });
    await page.mouse.up();
    await drawn(page);
    const after = await read(page, () => swarmanoid.standing);
    assert.ok(away(after.heading - before.heading - 28.6) < 1 && Math.abs(after.pitch - before.pitch) < 1, JSON.stringify([before, after]));
    await page.keyboard.press("Escape");
    assert.equal(await read(page, () => swarmanoid.aboard), null);
    assert.equal(await read(page, () => swarmanoid.selected), "fb");
  },

  async "two fingers move and zoom the plan"() {
    oneRobot("pinched", "5, 5, 0");
    const { url } = await attach();
    const page = await drawnPage(url, { quality: "plan", viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    const session = await page.context().newCDPSession(page);
    const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const { span } = await read(page, () => swarmanoid.viewpoint);
    await touch("touchStart", [150, 400], [250, 400]);
    for (let i = 1; i <= 10; i++) await touch("touchMove", [150 - 5 * i, 400], [250 + 5 * i, 400]);
    await touch("touchEnd");
    const now = await read(page, () => swarmanoid.viewpoint);
    assert.ok(Math.abs(span / now.span - 2) < 0.1, `${span / now.span} times as near`);
  },

  async "in the plan ten thousand robots stand out from the floor"() {
    run("diffusion_10000", "--real-time", 1, "--ticks", 0);
    const { url } = await attach();
    for (const colorScheme of ["light", "dark"]) {
      const page = await drawnPage(url, { quality: "plan", colorScheme, viewport: { width: 1280, height: 800 } });
      assert.deepEqual(await read(page, () => swarmanoid.instances()[0].drawn), [10000, 0]);
      const { x, y } = await read(page, () => swarmanoid.projectPoint(50, 50, 0));
      await shows(async () => {
        const seen = (await pixelsAbout(page, { x, y }, 60)).map(brightness).sort((a, b) => a - b);
        const [darkest, lightest] = [seen[Math.floor(seen.length / 20)], seen[Math.floor((seen.length * 19) / 20)]];
        assert.ok(contrast(lightest, darkest) > 3, `${colorScheme}: ${darkest} and ${lightest}`);
      });
      await page.close();
    }
  },

  async "it can be read by everybody, by day and night, and used by keyboard alone"() {
    run("prey_retrieval", "--real-time", 1);
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { bypassCSP: true });
    assert.deepEqual(await barriers(page), []);
    // The list by arrows, the inspector's values by tab and enter.
    await page.keyboard.press("/");
    await page.keyboard.type("fb_3");
    await page.focus("[role=listbox]");
    await page.keyboard.press("ArrowDown");
    await until(page, () => document.querySelector(".right .plot-button"));
    const plots = await page.locator(".plot").count();
    await page.focus(".plot-button >> nth=0");
    await page.keyboard.press("Enter");
    assert.equal(await page.locator(".plot").count(), plots + 1);
    await until(page, () => document.querySelector(".right").textContent.includes("Sensor"));
    // Many readings are one control.
    await page.focus(".bars >> nth=0");
    for (const key of ["ArrowRight", "ArrowRight", "Enter"]) await page.keyboard.press(key);
    await until(page, () => document.querySelector(".bars .reading:nth-child(3)").classList.contains("plotted"));
    assert.match(await page.getAttribute(".bars >> nth=0", "aria-valuetext"), /: -?[\d.]+ /);
    await page.keyboard.press("g");
    await page.keyboard.press("w");
    await page.click(".tools summary");
    await page.selectOption("[aria-label='Colours of robots']", "speed");
    await page.keyboard.press("j");
    await until(page, () => !document.querySelector(".legend").hidden);
    await page.click(".place summary");
    assert.deepEqual(await barriers(page), [], "with a card, the log and the tools");
    await page.keyboard.press("F1");
    assert.deepEqual(await barriers(page), [], "help");
  },

  async "on a phone list and inspector open over the picture and close again"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    // Nothing is wider than the screen, and a finger hits each button.
    assert.ok((await read(page, () => document.documentElement.scrollWidth)) <= 390);
    for (const box of await read(page, () => [...document.querySelectorAll("header button:not([hidden])")].map((button) => button.getBoundingClientRect().toJSON())))
      assert.ok(box.width >= 36 && box.height >= 32 && box.right <= 390, JSON.stringify(box));
    const { height } = await page.locator("main").boundingBox();
    assert.ok(height > 0.7 * 844, `the picture has ${height} pixels`);
    await page.tap(".tools summary");
    for (const box of await read(page, () => [...document.querySelectorAll(".tools :is(button, select):not([hidden])")].map((each) => each.getBoundingClientRect().toJSON())))
      assert.ok(box.width >= 36 && box.height >= 32 && box.right <= 390, JSON.stringify(box));
    await page.tap(".tools .views button >> text=Trails");
    await page.waitForSelector(`.views button[aria-pressed="true"] >> text=Trails`);
    await page.tap(".tools summary");
    await page.waitForSelector(".left", { state: "hidden" });
    await page.tap(".list-button");
    await page.waitForSelector(".left", { state: "visible" });
    await page.tap(".row >> nth=3");
    await page.waitForSelector(".right", { state: "visible" });
    await page.tap(".list-button");
    await page.waitForSelector(".left", { state: "hidden" });
    // The robot is still to be seen above its card.
    assert.ok((await page.locator(".right").boundingBox()).height < 0.5 * 844);
    await page.tap(".right .close");
    await page.waitForSelector(".right", { state: "hidden" });
    await page.tap("header .controls button >> nth=0");
    await until(page, () => swarmanoid.phase === "paused");
  },

  async "the quality follows the pace of the pictures, or the wish"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 100000);
    const { url } = await attach();
    const page = await drawnPage(url, { quality: "auto", viewport: { width: 1280, height: 800 } });
    // The browser of this test draws in software.
    assert.equal(await read(page, () => swarmanoid.quality), "plan");
    await page.selectOption(".quality", "3D");
    await until(page, () => swarmanoid.view === "3D");
    assert.match(await read(page, () => swarmanoid.quality), /^(high|medium|low|least)$/);
    const size = () => [document.querySelector(".picture:not([hidden])").width, document.querySelector("main").clientWidth];
    for (const [quality, ratio] of [["high", 1], ["least", 0.5], ["medium", 1], ["low", 1]]) {
      await page.selectOption(".quality", quality);
      assert.equal(await read(page, () => swarmanoid.quality), quality);
      const [pixels, width] = await read(page, size);
      assert.ok(Math.abs(pixels - ratio * width) <= 1, `${quality}: ${pixels} of ${width}`);
      const before = await read(page, () => swarmanoid.drawn);
      await until(page, (count) => swarmanoid.drawn > count + 2, before);
      await until(page, () => swarmanoid.instances()[0]?.drawn.reduce((a, b) => a + b) === 10);
    }
  },

  async "without a graphics card ten thousand robots in three dimensions are points in their colours, and said to be drawn larger"() {
    run("diffusion_10000", "--real-time", 1, "--ticks", 0, "--no-visualisers");
    const { url } = await attach();
    for (const colorScheme of ["light", "dark"]) {
      const page = await drawnPage(url, { quality: "plan", colorScheme, viewport: { width: 900, height: 600 } });
      assert.match(await page.textContent(".scale"), /robots up to [\d.]+× as wide/);
      await page.selectOption(".quality", "3D");
      await until(page, () => swarmanoid.view === "3D");
      // It begins with a quality for processors, and no robot needs a model.
      assert.match(await read(page, () => swarmanoid.quality), /^(low|least)$/);
      await page.selectOption(".quality", "low");
      await drawn(page);
      assert.deepEqual(await read(page, () => swarmanoid.instances()), [{ robots: 10000, drawn: [0, 0, 10000] }]);
      assert.match(await page.textContent(".scale"), /robots up to [\d.]+× as wide/);
      const middle = await read(page, () => swarmanoid.projectPoint(50, 50, 0));
      await shows(async () => {
        const seen = (await pixelsAbout(page, middle, 60)).map(brightness).sort((a, b) => a - b);
        const [darkest, lightest] = [seen[Math.floor(seen.length / 20)], seen[Math.floor((seen.length * 19) / 20)]];
        assert.ok(contrast(lightest, darkest) > 3, `${colorScheme}: from ${darkest} to ${lightest}`);
      });
      await read(page, () => swarmanoid.colourBy("distance from the middle"));
      await until(page, () => swarmanoid.colouring.high > 60);
      const corner = await read(page, () => swarmanoid.projectPoint(95, 5, 0));
      const colours = async (at) => (await pixelsAbout(page, at, 12)).filter((pixel) => saturation(pixel) > 60);
      await shows(async () => {
        const [far, near] = [await colours(corner), await colours(middle)];
        assert.ok(far.length > 5 && far.every(([r, , b]) => r > b), `yellow in the corner: ${far.slice(0, 5)}`);
        assert.ok(near.length > 5 && near.every(([r, , b]) => r < b), `blue in the middle: ${near.slice(0, 5)}`);
      });
      await read(page, () => swarmanoid.approach("fb_1234"));
      await until(page, () => swarmanoid.instances()[0].drawn[0] > 0);
      await page.close();
    }
  },

  async "ten thousand robots are drawn and found"() {
    run("diffusion_10000", "--real-time", 1, "--ticks", 0);
    const { url } = await attach();
    const page = await drawnPage(url);
    assert.equal(await read(page, () => swarmanoid.robots), 10000);
    const [{ robots, drawn: counts }] = await read(page, () => swarmanoid.instances());
    assert.equal(robots, 10000);
    assert.ok(counts.reduce((a, b) => a + b) > 9000, `${counts} are drawn`);
    await page.fill("input[type=search]", "fb_9876");
    assert.equal(await read(page, () => swarmanoid.shown), 1);
    assert.ok((await page.locator(".row").count()) < 60);
    await page.fill("input[type=search]", "");
    await read(page, () => swarmanoid.approach("fb_1234"));
    await until(page, () => swarmanoid.instances()[0].drawn[0] > 0);
    await until(page, () => swarmanoid.tick > 2);
  },

  async "the timeline looks back at any tick while the run goes on, with the poses of that time"() {
    run("diffusion_10", "--real-time", 5, "--ticks", 0, "--no-visualisers", "--output", "goes_on");
    const { url } = await attach();
    const page = await drawnPage(url);
    await until(page, () => swarmanoid.timeline?.last > 120);
    await read(page, () => swarmanoid.select("fb_3"));
    const [first, second] = [[30, 101], [100, 7]];
    for (const [from, tick] of [first, second]) {
      await page.evaluate((t) => swarmanoid.lookBack(t), from);
      await page.evaluate((t) => swarmanoid.lookBack(t), tick);
      await until(page, (t) => swarmanoid.past.shown === t && swarmanoid.tick === t, tick);
      await until(page, (t) => document.querySelector(".timeline output").textContent.includes(`tick ${t}`), tick);
      const table = new Process("export", "goes_on", "--csv", "-", "--columns", "x,y", "--entities", "fb_3", "--from", tick, "--until", tick);
      assert.equal(await table.ended, 0, table.output);
      const there = table.output.trim().split("\n")[1].split(",").slice(4).map(Number);
      const near = ([x, y]) => Math.hypot(swarmanoid.place("fb_3")[0] - x, swarmanoid.place("fb_3")[1] - y) < 1e-5;
      await until(page, near, there);
      const row = (name) => Number([...document.querySelectorAll(".right th")].find((th) => th.textContent === name).nextSibling.textContent.split(" ")[0]);
      assert.ok(Math.abs((await page.evaluate(`(${row})("x")`)) - there[0]) < 1e-3);
    }
    // Computed once the tick stands: what the command says.
    const command = new Process("inspect", "goes_on@7", "fb_3", "--json");
    assert.equal(await command.ended, 0, command.output);
    const { sensors } = JSON.parse(command.output.slice(command.output.indexOf("{"))).robots[0];
    const proximity = sensors.find(({ type }) => type === "footbot_proximity").readings.map(({ value }) => value);
    const bars = () => [...document.querySelectorAll(".right details:not([hidden]) .bars > *")].map((bar) => bar.title);
    await until(page, (count) => document.querySelectorAll(".right details:not([hidden]) .bars > *").length === count, proximity.length);
    (await page.evaluate(`(${bars})()`)).forEach((title, i) => assert.ok(Math.abs(Number(title.split(": ")[1].split(" ")[0]) - proximity[i]) < 1e-3, title));

    // The present goes on meanwhile, and is not shown.
    const frames = await read(page, () => swarmanoid.frames);
    await until(page, (before) => swarmanoid.frames > before + 3, frames);
    assert.equal(await tickOf(page), 7);
    await page.keyboard.press(".");
    await until(page, () => swarmanoid.tick === 8);
    await page.keyboard.press(",");
    await until(page, () => swarmanoid.tick === 7);
    await page.focus(".track");
    await page.keyboard.press("ArrowRight");
    await until(page, () => swarmanoid.tick === 8);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("z");
    await until(page, () => swarmanoid.tick > 12 && swarmanoid.past.playing);
    await page.keyboard.press("z");
    await until(page, () => !swarmanoid.past.playing);
    assert.ok((await tickOf(page)) < 120);
    await page.keyboard.press("q");
    await until(page, () => swarmanoid.past === null && swarmanoid.tick > 120);
    await until(page, () => document.querySelector(".timeline output").textContent.startsWith("live"));
    await until(page, () => document.querySelector(".right .state").hidden || !document.querySelector(".right .state").textContent.includes("journal"));
  },

  async "the timeline has events as marks, and a branch from the tick that is looked at"() {
    write("asked.csv", "tick,request,entity,numbers,from\n20,move,fb_1,1 1 0,anna@lab\n40,remove,fb_2,,\n");
    const first = run("diffusion_10", "--real-time", 1, "--ticks", 150, "--no-visualisers", "--output", "with events", "--events", "asked.csv");
    const { viewer, url } = await attach();
    const page = await drawnPage(url, { permissions: ["clipboard-read", "clipboard-write"] });
    await until(page, () => swarmanoid.timeline?.events.length === 2);
    assert.deepEqual(await read(page, () => swarmanoid.timeline.events), [[20, "move"], [40, "remove"]]);
    await first.ended;
    await until(page, () => swarmanoid.phase === "finished" && swarmanoid.timeline.last === 150);
    await page.click(".event-mark[data-what=move]");
    await until(page, () => swarmanoid.tick === 20 && Math.hypot(swarmanoid.place("fb_1")[0] - 1, swarmanoid.place("fb_1")[1] - 1) < 1e-5);
    assert.match(await page.getAttribute(".event-mark[data-what=move]", "title"), /tick 20: move fb_1 \(.*anna@lab.*\)/);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press(">");
    await until(page, () => swarmanoid.tick === 40 && swarmanoid.place("fb_2").length === 0);
    await page.keyboard.press("<");
    await until(page, () => swarmanoid.tick === 20 && swarmanoid.place("fb_2").length === 3);
    await page.keyboard.press("B");
    await until(page, () => swarmanoid.branch !== null);
    const command = await read(page, () => swarmanoid.branch);
    assert.equal(command, `swarmanoid run --branch '${join(folder, "with events")}'@20`);
    assert.equal(await read(page, () => navigator.clipboard.readText()), command);
    await read(page, () => swarmanoid.select("fb_1"));
    await page.keyboard.press("I");
    await until(page, () => swarmanoid.inspect !== null);
    assert.equal(await read(page, () => swarmanoid.inspect), `swarmanoid inspect '${join(folder, "with events")}'@20 fb_1`);
    assert.equal(await read(page, () => navigator.clipboard.readText()), await read(page, () => swarmanoid.inspect));
    const branch = new Process("run", "--branch", `${join(folder, "with events")}@20`, "--events", "with events/events.csv", "--quiet", "--output", "branch");
    assert.equal(await branch.ended, 0, branch.output);
    const hash = (text) => /hash ([0-9a-f]{16})/.exec(text)[1];
    assert.equal(hash(branch.output), hash(first.output));
    await viewer.end();
  },

  async "trails and plots end at the tick that is looked at, and the present goes on in them afterwards"() {
    run("diffusion_10", "--real-time", 5, "--ticks", 0, "--no-visualisers", "--output", "trails");
    const { url } = await attach();
    const page = await drawnPage(url, { quality: "plan" });
    await read(page, () => swarmanoid.show("trails", true));
    await read(page, () => swarmanoid.select("fb_3"));
    await until(page, () => swarmanoid.timeline?.last > 150 && swarmanoid.plots[0]?.points > 20);
    for (const tick of [120, 40]) {
      await page.evaluate((t) => swarmanoid.lookBack(t), tick);
      await until(page, ([t, points]) => swarmanoid.plots[0].last === t / 10 && swarmanoid.plots[0].points >= points && swarmanoid.trail("fb_3").length >= points, [tick, tick / 4]);
      const [x, y] = await read(page, () => swarmanoid.trail("fb_3").at(-1));
      await until(page, ([x, y]) => Math.hypot(x - swarmanoid.place("fb_3")[0], y - swarmanoid.place("fb_3")[1]) < 0.05, [x, y]);
    }
    // What the robot sensed at that tick is computed although earlier ticks were asked for since.
    await until(page, () => document.querySelectorAll(".right details:not([hidden]) .bars > *").length > 0);
    await page.keyboard.press("q");
    await until(page, () => swarmanoid.past === null && swarmanoid.plots[0].last > 15);
  },

  async "keys work after the timeline, the speed and the quality were touched"() {
    run("diffusion_10", "--real-time", 1, "--ticks", 0, "--no-visualisers", "--output", "touched");
    const { url } = await attach("--allow-control");
    const page = await drawnPage(url);
    await until(page, () => swarmanoid.control === "granted" && swarmanoid.timeline?.last > 20);
    const pressed = async (what) => {
      const before = await read(page, () => document.querySelector(".toggle[title^=Ids]").getAttribute("aria-pressed"));
      await page.keyboard.press("i");
      await until(page, (b) => document.querySelector(".toggle[title^=Ids]").getAttribute("aria-pressed") !== b, before).catch(() => assert.fail(`no key after ${what}`));
    };
    await page.selectOption('[aria-label="Speed"]', "2");
    await page.focus('[aria-label="Speed"]');
    await pressed("the speed");
    await page.selectOption(".quality", "least");
    await page.focus(".quality");
    await pressed("the quality");
    await page.click(".track");
    await until(page, () => swarmanoid.past !== null);
    await pressed("the timeline");
    await page.keyboard.press(" ");
    await until(page, () => swarmanoid.phase === "paused");
    // The arrow keys move the slider that has the focus, and text fields keep all keys.
    const tick = await read(page, () => swarmanoid.past.tick);
    await page.keyboard.press("ArrowRight");
    await until(page, (t) => swarmanoid.past.tick === t + 1, tick);
    await page.fill("input[type=search]", "");
    await page.type("input[type=search]", "i");
    assert.equal(await page.inputValue("input[type=search]"), "i");
    await page.keyboard.press("Escape");
    await page.keyboard.press("+");
    await until(page, () => document.querySelector('[aria-label="Speed of playing the past"]').value === "2");
  },

  async "a run that its own page has ended is told so, and the page asks for nothing until it is told to"() {
    const text = textOf("diffusion_10").replace(/<visualisations>[^]*<\/visualisations>/, '<visualisations><web_render id="page" allow_control="true"/></visualisations>');
    write("ended.xml", text);
    const one = new Process("run", "ended.xml", "--quiet", "--real-time", 1, "--ticks", 0, "--output", "ended");
    const [, url] = await one.says(/web_render: (http\S+)/);
    const page = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/] });
    await until(page, () => swarmanoid.control === "granted");
    page.on("dialog", (dialog) => dialog.accept());
    await page.click('[aria-label="End the run"]');
    assert.equal(await one.ended, 0, one.output);
    await until(page, () => !swarmanoid.connected);
    await until(page, () => /You have ended the run/.test(document.querySelector(".banner").textContent) && document.querySelector(".banner").dataset.kind === "calm");
    let asked = 0;
    page.on("websocket", () => asked++);
    await page.waitForTimeout(1500);
    assert.equal(asked, 0);
    new Process("run", "ended.xml", "--quiet", "--real-time", 1, "--ticks", 0, "--output", "again");
    await until(page, () => {
      if (!swarmanoid.connected) document.querySelector(".banner button:not([hidden])")?.click();
      return swarmanoid.connected && swarmanoid.phase === "running";
    });
  },

  async "Branch here starts a run from the tick that is looked at, with a page of its own"() {
    run("diffusion_10", "--real-time", 2, "--ticks", 0, "--no-visualisers", "--output", "branched");
    const { viewer, url } = await attach("--allow-control");
    const page = await drawnPage(url, { quality: "plan" });
    await until(page, () => swarmanoid.control === "granted" && swarmanoid.timeline?.last > 60);
    await page.evaluate(() => swarmanoid.lookBack(50));
    await until(page, () => swarmanoid.tick === 50);
    await page.click("text=Branch here");
    await page.waitForSelector(".branches a");
    assert.equal(await page.textContent(".branches a"), "Run from 50");
    const branch = await drawnPage(await page.getAttribute(".branches a", "href"), { quality: "plan" });
    await until(branch, () => swarmanoid.control === "granted" && swarmanoid.tick > 52);
    const { branch_of: of } = JSON.parse(readFileSync(join(folder, "branched/branch-50/manifest.json"), "utf8"));
    assert.deepEqual([of.run, of.tick], [join(folder, "branched"), 50]);
    // A second one has another folder, and all end with the page's server.
    await page.keyboard.press("B");
    await until(page, () => document.querySelectorAll(".branches a").length === 2);
    assert.ok(existsSync(join(folder, "branched/branch-50-2")));
    branch.complaints = [];
    await branch.close();
    await viewer.end();
    const ended = () => ["branch-50", "branch-50-2"].every((name) => JSON.parse(readFileSync(join(folder, "branched", name, "manifest.json"), "utf8")).exit_code !== undefined);
    for (const deadline = Date.now() + TIMEOUT_MS; !ended(); await page.waitForTimeout(100)) assert.ok(Date.now() < deadline, "a branch goes on");
    page.complaints = [];
  },

  async "a replay has the timeline, and a run without a journal has none"() {
    const done = run("diffusion_10", "--ticks", 200, "--no-visualisers", "--output", "done");
    assert.equal(await done.ended, 0, done.output);
    const replay = new Process("replay", "done", "web", "--from", "190");
    const [, url] = await replay.says(/web_render: (http\S+)/);
    const page = await drawnPage(url, { noise: [/ERR_CONNECTION_REFUSED/] });
    await until(page, () => swarmanoid.timeline?.last === 200);
    await read(page, () => swarmanoid.lookBack(33));
    await until(page, () => swarmanoid.tick === 33);
    await replay.end();

    run("diffusion_10", "--real-time", 5, "--ticks", 0, "--no-visualisers", "--no-journal", "--output", "without");
    const { url: other } = await attach();
    const bare = await drawnPage(other);
    await until(bare, () => swarmanoid.tick > 20);
    assert.equal(await read(bare, () => swarmanoid.timeline), null);
    await bare.keyboard.press(",");
    assert.equal(await read(bare, () => swarmanoid.past), null);
  },

  async "the timeline fits on a phone, and can be read in light and dark"() {
    run("diffusion_10", "--real-time", 5, "--ticks", 0, "--no-visualisers", "--output", "phone");
    const { url } = await attach();
    const page = await drawnPage(url, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, bypassCSP: true });
    await until(page, () => swarmanoid.timeline?.last > 30);
    const before = (await page.locator("main").boundingBox()).height;
    await read(page, () => swarmanoid.lookBack(10));
    await until(page, () => swarmanoid.tick === 10);
    assert.equal((await page.locator("main").boundingBox()).height, before, "the picture keeps its size");
    assert.ok((await read(page, () => document.documentElement.scrollWidth)) <= 390);
    for (const box of await read(page, () => [...document.querySelectorAll(".timeline > button, .track")].map((each) => each.getBoundingClientRect().toJSON())))
      assert.ok(box.width >= 36 && box.height >= 28 && box.left >= 0 && box.right <= 390, JSON.stringify(box));
    assert.deepEqual(await barriers(page), []);
  },
};

await runCases(tests);
