// `swarmanoid edit` in headless Chromium: what hands and forms do to the file, byte for byte. Waits for the state of the
// page and the bytes of the file, never for time. Ends with 77 if there is no browser.
//
// Environment: see harness.mjs.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { barriers, folder, open, Process, read, runCases, settled, textOf, until, write } from "./harness.mjs";

const { SWARMANOID_CONFIGS } = process.env;

// ---- the editor and its page ----

let copies = 0;
// A copy of a sample, on a page with the token; more: text that is changed before.
async function edit(name, { change = (text) => text, ...more } = {}) {
  const text = change(textOf(name));
  const file = write(`${name}_${copies++}.xml`, text);
  const editor = Object.assign(new Process("edit", file), { file, text });
  [, editor.url] = await editor.says(/Edit it: (http\S+)/);
  editor.page = await open(editor.url, { quality: "plan", viewport: { width: 1200, height: 640 }, ...more });
  await until(editor.page, () => swarmanoid.editor?.form && swarmanoid.drawn > 0);
  return editor;
}

const onDisk = ({ file }) => readFileSync(file, "utf8");

// After something that changes the text: the revision that comes of it.
async function changed(page, act) {
  const before = await read(page, () => swarmanoid.editor.revision);
  await act();
  await until(page, (revision) => swarmanoid.editor.revision > revision && !swarmanoid.editor.busy && swarmanoid.editor.form?.revision === swarmanoid.editor.revision, before);
  return read(page, () => swarmanoid.editor);
}

async function save(editor) {
  await editor.page.keyboard.press("Control+s");
  await until(editor.page, () => swarmanoid.editor.saved);
  return onDisk(editor);
}

// By the list; name: of its element.
async function select(page, id, name = id) {
  await page.fill("input[type=search]", `id:${id}`);
  await page.click(`.left .row:not([hidden]):has(.id:text-is("${id}"))`);
  await until(page, (wanted) => swarmanoid.editor.form?.name === wanted && swarmanoid.selected !== null, name);
  await page.fill("input[type=search]", "");
}

async function fill(page, name, value) {
  await page.fill(`.edit-form [name="${name}"]`, value);
  await page.press(`.edit-form [name="${name}"]`, "Tab");
}

// Noise of a page whose run has ended: it has tried to connect.
const noise = [/WebSocket connection to .* failed/];

// Presses Run, and waits for the page of the run.
async function startRun(page) {
  await page.click('header button:text-is("Run")');
  await inRun(page);
}
async function inRun(page) {
  await page.waitForURL(/[?&]run=1/);
  await until(page, () => window.swarmanoid?.run.phase === "running" && swarmanoid.control === "granted" && swarmanoid.drawn > 0);
}
const inEditor = (page) => until(page, () => !location.search.includes("run=") && window.swarmanoid?.editor?.form && swarmanoid.drawn > 0);
const runsOf = (name) => readdirSync(join(folder, "runs")).filter((each) => each.startsWith(`${name}-`));

// The lines that two texts do not share.
function differences(a, b) {
  const [left, right] = [a.split("\n"), b.split("\n")];
  return { gone: left.filter((line) => !right.includes(line)), come: right.filter((line) => !left.includes(line)) };
}

// ---- tests ----

const tests = {
  async "from an empty arena to a running swarm without a typed word of XML"() {
    const text = `<?xml version="1.0"?>
<ahss-config>
  <framework maxclock="50"/>
  <arena size="4, 4, 1" optimization="2D"/>
  <engines><dummy_engine id="ground"/></engines>
  <arena_physics><engine id="ground"><all/></engine></arena_physics>
</ahss-config>
`;
    const editor = await edit("diffusion_10", { change: () => text });
    const { page } = editor;
    const mistakes = () => page.textContent(".mistakes");
    await until(page, () => document.querySelector(".mistakes").textContent.includes("has no entities"));
    await page.selectOption(".palette select", "footbot");
    await settled(page);
    const click = async (x, y) => {
      const at = await page.evaluate(([a, b]) => swarmanoid.projectPoint(a, b, 0), [x, y]);
      await page.mouse.click(at.x, at.y);
    };
    await changed(page, () => click(1, 1));
    await until(page, () => document.querySelector(".mistakes").textContent.includes("the robot 'footbot_1' has no controller"));
    assert.equal(await page.locator(".palette").count(), 1);
    await page.keyboard.press("Escape");
    // The root, its controllers, and one of the known ones, which comes with library and devices.
    await page.click(".above button >> nth=0");
    await until(page, () => swarmanoid.editor.form?.path === "");
    const add = async (tag) => {
      await page.selectOption(".adder select", tag);
      await changed(page, () => page.click(".adder button"));
    };
    await add("controllers");
    await until(page, () => swarmanoid.editor.form?.name === "<controllers>");
    assert.match(await page.getAttribute('.adder option[value="footbot_diffusion"]', "title"), /Library footbot_diffusion, with devices as in \S+\.xml/);
    await add("footbot_diffusion");
    assert.equal(await page.inputValue('.edit-form [name="library"]'), "footbot_diffusion");
    await select(page, "footbot_1");
    await changed(page, () => fill(page, "controller", "footbot_diffusion_1"));
    await page.selectOption(".palette select", "footbot");
    await changed(page, () => click(3, 3));
    await until(page, () => document.querySelector(".mistakes").textContent === "No mistakes").catch(async () => assert.fail(await mistakes()));
    const saved = await save(editor);
    assert.equal(saved.match(/footbot_diffusion_1/g).length, 3);
    const run = new Process("run", editor.file, "--single-process", "--quiet");
    assert.equal(await run.ended, 0, run.output);
    assert.match(run.output, /finished: 50 ticks, 2 entities/);
  },

  async "a hand moves, turns, places and removes; what it did not touch stays, byte for byte"() {
    const editor = await edit("prey_retrieval");
    const { page } = editor;
    await settled(page, "fb_1");
    const [from, to] = [await read(page, () => swarmanoid.project("fb_1")), await read(page, () => swarmanoid.projectPoint(1.5, 0.5, 0))];
    assert.equal(await page.textContent(".pill"), "editing");
    assert.ok(!/null|undefined/.test(await page.textContent("body")));
    let state = await changed(page, async () => {
      await page.keyboard.down("Shift");
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move((from.x + to.x) / 2, to.y);
      await page.mouse.move(to.x, to.y);
      await page.mouse.up();
      await page.keyboard.up("Shift");
    });
    assert.equal(state.undo, "place fb_1");
    assert.equal(state.saved, false);
    await until(page, () => Math.hypot(swarmanoid.place("fb_1")[0] - 1.5, swarmanoid.place("fb_1")[1] - 0.5) < 0.05);
    assert.equal(onDisk(editor), editor.text); // not before Save
    const saved = await save(editor);
    const { gone, come } = differences(editor.text, saved);
    assert.deepEqual([gone.length, come.length], [1, 1]);
    assert.match(gone[0], /<position>1.0, 1.0, 0<\/position>/);
    const [, x, y] = /^ {6}<position>(\S+), (\S+), 0<\/position>$/.exec(come[0]);
    assert.ok(Math.hypot(x - 1.5, y - 0.5) < 0.05, come[0]);

    // A wall, which no run could move.
    await page.mouse.click(...Object.values(await read(page, () => swarmanoid.projectPoint(0.02, 2.5, 0))).slice(0, 2));
    await until(page, () => swarmanoid.editor.form.name === "wall_west" && swarmanoid.selected === "wall_west");
    state = await changed(page, () => page.click(".edit-form .head button"));
    assert.equal(state.undo, "remove wall_west");
    await until(page, () => swarmanoid.shown === 10);

    await page.selectOption(".palette select", "footbot");
    await settled(page, "fb_1");
    const free = await read(page, () => swarmanoid.projectPoint(2.5, 3, 0));
    state = await changed(page, () => page.mouse.click(free.x, free.y));
    assert.equal(state.form.name, "fb_4");
    assert.equal(state.form.parameters.find(({ name }) => name === "controller").value, "retriever");
    await until(page, () => swarmanoid.selected === "fb_4" && swarmanoid.shown === 11);
    await page.keyboard.press("Escape");
    state = await changed(page, () => page.keyboard.press("Delete"));
    assert.equal(state.undo, "remove fb_4");
    for (const wanted of ["add fb_4", "remove wall_west", "place fb_1", null]) {
      state = await changed(page, () => page.keyboard.press("Control+z"));
      assert.equal(state.undo, wanted);
    }
    assert.equal(state.saved, false);
    assert.equal(await save(editor), editor.text);
    state = await changed(page, () => page.keyboard.press("Control+y"));
    assert.equal(state.undo, "place fb_1");
    assert.equal(await save(editor), saved);
    assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith(".")), []);
    editor.child.kill("SIGINT");
    assert.equal(await editor.ended, 0);
  },

  async "forms set values, add devices, and say what is wrong and where"() {
    const editor = await edit("prey_retrieval");
    const { page } = editor;
    await select(page, "wall_north");
    let state = await changed(page, () => fill(page, "size", "5, 0.2, 0.4"));
    assert.ok(state.mistakes.every(({ kind }) => kind === "note"));
    state = await changed(page, () => fill(page, "size", "5, none"));
    const [mistake] = state.mistakes;
    assert.match(mistake.place, /prey_retrieval_\d+\.xml:\d+:\d+$/);
    assert.equal(editor.text.split("\n")[Number(mistake.place.split(":").at(-2)) - 1].trim(), "<size>5, 0.1, 3</size>");
    assert.ok(await page.isDisabled("text=Check"));
    await select(page, "fb_2");
    await page.click(".mistakes button");
    await until(page, () => swarmanoid.editor.form.tag === "size" || swarmanoid.editor.form.name === "wall_north");
    await changed(page, () => page.keyboard.press("Control+z"));
    await until(page, () => swarmanoid.editor.all_mistakes === 0);

    // The controller of a robot, and a sensor for it.
    await select(page, "fb_2");
    const crumb = (name) => page.click(`.above button:text-is("${name}")`);
    await crumb("<ahss-config>");
    await page.click('.parts button:has-text("controllers")');
    await page.click('.parts button:has-text("retriever")');
    await page.click('.parts button:has-text("sensors")');
    await until(page, () => swarmanoid.editor.form.tag === "sensors");
    await page.selectOption(".adder select", "footbot_light");
    state = await changed(page, () => page.click(".adder button"));
    assert.equal(state.form.tag, "footbot_light");
    assert.equal(state.undo, "add <footbot_light>");
    assert.equal(state.form.parameters[0].value, "generic_footbot_light");
    await page.click("text=Check");
    await page.waitForSelector("text=Checked ✓");

    // What no form says: the text of the element.
    await crumb("<sensors>");
    await until(page, () => swarmanoid.editor.form.tag === "sensors");
    await page.click(".xml summary");
    await page.fill(".xml textarea", "<sensors/></footbot_retriever>");
    await page.click(".xml button");
    await page.waitForSelector(".refusal:not(:empty)");
    const saved = await save(editor);
    const { gone, come } = differences(editor.text, saved);
    assert.deepEqual(gone.map((line) => line.trim()), ["<size>5, 0.1, 3</size>"].slice(0, gone.length));
    assert.ok(come.some((line) => line.includes("footbot_light")), come.join("\n"));
  },

  async "a distribution is edited as one, and written out robot by robot"() {
    const editor = await edit("diffusion_10");
    const { page } = editor;
    await select(page, "fb_3", "fb");
    assert.equal(await read(page, () => swarmanoid.editor.form.distributed), true);
    assert.equal(await read(page, () => swarmanoid.chosen.length), 10);
    const place = await read(page, () => swarmanoid.place("fb_3"));
    await page.click(".edit-form p button");
    await until(page, () => swarmanoid.editor.form.tag === "distribute");
    let state = await changed(page, () => fill(page, "quantity", "12"));
    await until(page, () => swarmanoid.robots === 12);
    state = await changed(page, () => page.keyboard.press("Control+z"));
    await until(page, () => swarmanoid.editor.form.tag === "distribute" && swarmanoid.robots === 10);
    state = await changed(page, () => page.click("text=Write its entities out one by one"));
    assert.equal(state.all_mistakes, 0);
    await until(page, (wanted) => swarmanoid.place("fb_3").join() === wanted, place.join()); // the state follows the world
    const saved = await save(editor);
    assert.equal(saved.match(/<footbot id="fb_\d"/g).length, 10);
    assert.equal(saved.slice(0, saved.indexOf("<footbot id")), editor.text.slice(0, editor.text.indexOf("<distribute")));
  },

  async "what others write is noticed, and who has no token only looks"() {
    const editor = await edit("diffusion_10");
    const { page } = editor;
    // Nothing is changed here: what is there is read.
    writeFileSync(editor.file, editor.text.replace('quantity="10"', 'quantity="7"'));
    await until(page, () => swarmanoid.robots === 7);
    assert.equal(await read(page, () => swarmanoid.editor.saved), true);

    await read(page, () => swarmanoid.select("wall_west"));
    await until(page, () => swarmanoid.editor.form.name === "wall_west");
    await changed(page, () => fill(page, "colour", "red"));
    writeFileSync(editor.file, editor.text);
    await page.waitForSelector(".mistakes [role=alert]");
    await page.keyboard.press("Control+s");
    await page.waitForSelector(".refusal:has-text('somebody else has changed')");
    assert.equal(onDisk(editor), editor.text);
    await page.click("text=Save over it");
    await until(page, () => swarmanoid.editor.saved);
    assert.match(onDisk(editor), /<colour>red<\/colour>/);

    const bare = await open(editor.url.split("#")[0]);
    await until(bare, () => swarmanoid.drawn > 0 && swarmanoid.control === "token needed");
    const before = onDisk(editor);
    await read(bare, () => swarmanoid.command({ do: "edit", revision: 1, change: "remove", paths: ["2/0"] }));
    await read(bare, () => swarmanoid.command({ do: "save", anyway: true }));
    await bare.waitForSelector(".last:has-text('only the address with the token')");
    assert.equal(await read(bare, () => swarmanoid.editor?.file), undefined);
    assert.equal(onDisk(editor), before);

    // Changes that are not saved keep it alive until they are.
    await changed(page, () => fill(page, "colour", "blue"));
    editor.child.kill("SIGINT");
    await editor.says(/changes that are not saved/);
    assert.equal(editor.code, undefined);
    await page.keyboard.press("Control+s");
    assert.equal(await editor.ended, 0);
    assert.match(onDisk(editor), /<colour>blue<\/colour>/);
  },

  async "Run shows the experiment as it is here in the same page, where it is steered; Edit goes back"() {
    const editor = await edit("diffusion_10", { noise });
    const { page } = editor;
    const name = editor.file.split("/").at(-1).replace(".xml", "");
    await select(page, "wall_west");
    await changed(page, () => fill(page, "colour", "red"));
    await startRun(page);
    assert.equal(new URL(page.url()).port, new URL(editor.url).port);
    assert.equal(await read(page, () => swarmanoid.experiment), name);
    assert.equal(await read(page, () => swarmanoid.selected), "wall_west");
    assert.equal(onDisk(editor), editor.text); // it ran what is not saved, and did not save it
    const [run] = runsOf(name);
    assert.match(readFileSync(join(folder, "runs", run, "experiment.xml"), "utf8"), /red/);
    await until(page, () => swarmanoid.tick > 3);
    await page.keyboard.press(" ");
    await until(page, () => swarmanoid.phase === "paused");
    const tick = await read(page, () => swarmanoid.tick);
    await page.keyboard.press("n");
    await until(page, (before) => swarmanoid.tick > before, tick);
    page.once("dialog", (dialog) => dialog.accept());
    await page.click('header .controls button[aria-label="Begin again at tick 0"]');
    await until(page, () => swarmanoid.tick === 0 && swarmanoid.phase === "paused" && swarmanoid.control === "granted");

    // Run again is another run, with the same pace.
    await page.keyboard.press("Control+Enter");
    for (let runs = 1; runs < 2; await page.waitForTimeout(50)) runs = runsOf(name).length;
    await until(page, () => swarmanoid.run.phase === "running" && swarmanoid.connected && swarmanoid.phase === "paused" && swarmanoid.control === "granted");

    // A page without the token watches the run, and neither steers nor ends it.
    const bare = await open(`${editor.url.split("#")[0]}?run=1`, { noise });
    await until(bare, () => swarmanoid.drawn > 0 && swarmanoid.control === "token needed").catch(() => {});
    if (await read(bare, () => swarmanoid.connected)) {
      for (const request of [{ do: "resume" }, { do: "stop" }]) await bare.evaluate((each) => swarmanoid.command(each), request);
      await bare.waitForSelector(".last:has-text('only the address with the token')");
    }
    await bare.close();

    await page.click('header button:text-is("Edit")');
    await inEditor(page);
    assert.equal(await read(page, () => swarmanoid.editor.saved), false);
    assert.equal(await read(page, () => swarmanoid.editor.undo), "set colour of wall_west");
    await until(page, () => swarmanoid.editor.run.phase === "none");
    const ended = () => runsOf(name).every((each) => JSON.parse(readFileSync(join(folder, "runs", each, "manifest.json"), "utf8")).exit_code !== undefined);
    while (!ended()) await page.waitForTimeout(50);
    await changed(page, () => page.keyboard.press("Control+z"));
    editor.child.kill("SIGINT");
    assert.equal(await editor.ended, 0);
  },

  async "an experiment with mistakes does not run"() {
    const { page } = await edit("diffusion_10");
    await select(page, "wall_west");
    await changed(page, () => fill(page, "size", "none"));
    assert.ok(await page.isDisabled('header button:text-is("Run")'));
    await changed(page, () => page.keyboard.press("Control+z"));
    assert.ok(!(await page.isDisabled('header button:text-is("Run")')));
  },

  async "a Lua script is edited beside the picture; an error is marked at its line, and one key runs it again"() {
    const template = (name) => readFileSync(join(SWARMANOID_CONFIGS, "../user/templates/script", name), "utf8").replaceAll("@name@", "avoid");
    mkdirSync(join(folder, "controllers/avoid"), { recursive: true });
    const script = write("controllers/avoid/avoid.lua", template("controller.lua.in"));
    const experiment = template("experiment.xml.in").replaceAll("@language@", "lua").replace("../controllers", "controllers").replaceAll("@ending@", "lua")
      .replace("<maxclock>600<", "<maxclock>60000<"); // on a busy machine a minute may be over before the page shows the run
    const editor = await edit("diffusion_10", { change: () => experiment, noise, bypassCSP: true });
    const { page } = editor;
    await page.click('header button:text-is("Script")');
    await until(page, () => document.querySelector(".script-pane textarea")?.value.includes("function step()"));
    const text = await page.inputValue(".script-pane textarea");
    assert.equal(text, readFileSync(script, "utf8"));
    assert.equal(await page.textContent(".script-lines span:last-child"), `${text.split("\n").length}\n`);

    // A mistake in the third step: the run ends, and the pane shows the line.
    const line = text.split("\n").findIndex((each) => each.startsWith("function step()")) + 2;
    const wrong = text.replace("function step()\n", "function step()\n  if robot.nothing.there then return end\n");
    await page.fill(".script-pane textarea", wrong);
    await page.press(".script-pane textarea", "Control+Enter");
    await until(page, () => /attempt to index a nil value/.test(document.querySelector(".script-error")?.textContent));
    assert.equal(readFileSync(script, "utf8"), wrong);
    assert.match(await page.textContent(".script-error"), new RegExp(`^Line ${line}: `));
    assert.equal(await page.textContent(".script-lines .wrong"), `${line}\n`);
    assert.ok(await page.isVisible(".script-band"));
    assert.deepEqual(await barriers(page), [], "the script and its error");
    // The mended script runs by the same key.
    await page.fill(".script-pane textarea", text);
    await page.press(".script-pane textarea", "Control+Enter");
    await inRun(page);
    assert.equal(readFileSync(script, "utf8"), text);
    await until(page, () => swarmanoid.tick > 3);
    assert.deepEqual(await barriers(page), [], "the run and the script");

    // The pane stays open beside the run, too: a text that is no Lua.
    assert.ok(await page.isVisible(".script-pane textarea"));
    await until(page, () => document.querySelector(".script-pane textarea")?.value.includes("function step()"));
    await page.fill(".script-pane textarea", `${text}\nend end\n`);
    await page.press(".script-pane textarea", "Control+Enter");
    await until(page, () => /^Line \d+: .*expected/.test(document.querySelector(".script-error")?.textContent) && swarmanoid.run.phase === "none");
    assert.match(await page.textContent(".banner"), /The run has failed/);
    await page.fill(".script-pane textarea", text.replace("local SPEED = p.speed", "local SPEED = 0 * p.speed"));
    await page.press(".script-pane textarea", "Control+Enter");
    await until(page, () => swarmanoid.run.phase === "running" && swarmanoid.connected && swarmanoid.control === "granted" && swarmanoid.tick > 3 && document.querySelector(".script-error").hidden);
    assert.match(readFileSync(script, "utf8"), /SPEED = 0/);

    // Another program has changed the script.
    writeFileSync(script, text);
    await page.fill(".script-pane textarea", `${text}-- mine\n`);
    await page.press(".script-pane textarea", "Control+s");
    await page.waitForSelector(".script-error:has-text('another program has changed')");
    assert.deepEqual(await barriers(page), [], "the choices about a changed script");
    assert.equal(readFileSync(script, "utf8"), text);
    await page.click('.script-pane button:text-is("Save over it")');
    await until(page, () => document.querySelector(".script-error").hidden);
    assert.equal(readFileSync(script, "utf8"), `${text}-- mine\n`);
  },

  async "it can be read in light and dark, and works in three dimensions"() {
    const { page } = await edit("prey_retrieval", { bypassCSP: true, noise });
    await select(page, "fb_1");
    await page.selectOption(".palette select", "footbot");
    assert.deepEqual(await barriers(page), [], "a form, and the palette");
    await page.keyboard.press("Escape");
    await select(page, "wall_north");
    await page.click("details.xml summary");
    await changed(page, () => fill(page, "size", "none"));
    assert.deepEqual(await barriers(page), [], "a mistake, and the text of an element");
    await changed(page, () => page.keyboard.press("Control+z"));
    // A wall is picked where it stands in either view.
    for (const quality of ["plan", "least"]) {
      await select(page, "fb_1");
      await page.selectOption(".quality", quality);
      await until(page, (wanted) => swarmanoid.view === (wanted === "plan" ? "plan" : "3D"), quality);
      await settled(page);
      const at = await read(page, () => swarmanoid.projectPoint(2.5, 5, 0.1));
      await page.mouse.click(at.x, at.y);
      await until(page, () => swarmanoid.editor.form.name === "wall_north");
    }
    await page.selectOption(".quality", "plan");
    await startRun(page);
    await until(page, () => swarmanoid.tick > 3);
    assert.deepEqual(await barriers(page), [], "the run");
  },
};

const STATE = `JSON.stringify(swarmanoid.editor ?? { at: location.href, run: swarmanoid.run, control: swarmanoid.control, tick: swarmanoid.tick,
  drawn: swarmanoid.drawn, banner: document.querySelector(".banner")?.textContent }).slice(0, 600)`;
await runCases(tests, { signal: "SIGKILL", state: STATE });
