// node search_test.mjs SITE: asks the search of the built site questions that users have. The search is the worker that the pages load. Fails if the
// wanted page is not among the first three pages of an answer.
import { readFileSync } from "node:fs";
import path from "node:path";
import vm from "node:vm";

const kFirst = 3;
const kQuestions = [
  ["exit code", "docs/command.html"],
  ["own robot", "docs/own_kind.html"],
  ["CCI_FootBotWheelsActuator", "api/classswarmanoid_1_1CCI__FootBotWheelsActuator.html"],
  ["CPhysicsEngine", "api/classswarmanoid_1_1CPhysicsEngine.html"],
  ["CSimulator", "api/classswarmanoid_1_1CSimulator.html"],
  ["GetAllSensorReadings", "api/"],
  ["write a sensor", "docs/own_device.html"],
  ["write a controller", "docs/own_controller.html"],
  ["compare two controllers", "docs/compare_controllers.html"],
  ["film", "docs/film.html"],
  ["cite a run", "docs/cite_a_run.html"],
  ["compatibility", "docs/compatibility.html"],
  ["several machines", "docs/running_a_cluster.html"],
  ["install on a cluster node", "docs/installing.html"],
  ["why do two runs differ", "docs/determinism.html"],
  ["random numbers", "docs/determinism.html"],
  ["noise", "docs/devices.html"],
  ["checkpoint", "docs/command.html"],
  ["lua", "docs/scripts.html"],
  ["rviz", "docs/ros2.html"],
  ["learning", "docs/python.html"],
  ["ticks per second", "docs/performance.html"],
  ["process dies", "docs/recovery.html"],
  ["stranger", "docs/security.html"],
  ["footbot_proximity", "docs/devices.html"],
  ["physics engine", "docs/engines.html"],
];

const site = process.argv[2];
const page = readFileSync(path.join(site, "index.html"), "utf8");
const settings = JSON.parse(page.match(/id="__config" type="application\/json">(.*?)<\/script>/s)[1]);

// The worker gets and sends messages as in a browser.
const waiting = [];
let receive;
const worker = vm.createContext({
  console,
  importScripts: () => {},
  addEventListener: (_, listener) => { receive = listener; },
  postMessage: (message) => waiting.shift()(message),
});
worker.self = worker;
vm.runInContext(readFileSync(path.join(site, settings.search), "utf8"), worker);
const ask = (message) => new Promise((resolve) => { waiting.push(resolve); receive({ data: message }); });

const { config, docs } = JSON.parse(readFileSync(path.join(site, "search/search_index.json"), "utf8"));
// The bundle of the pages sends these settings too.
const options = { pipeline: ["trimmer", "stopWordFilter"], suggestions: true };
config.lang = [settings.translations["search.config.lang"]];
await ask({ type: 0, data: { config, docs, options } });

let failed = 0;
for (const [question, wanted] of kQuestions) {
  const answer = await ask({ type: 2, data: question });
  const pages = answer.data.items.slice(0, kFirst).map((sections) => sections[0].location.split("#")[0]);
  const found = pages.some((location) => location === wanted || (wanted.endsWith("/") && location.startsWith(wanted)));
  if (found) continue;
  failed += 1;
  const all = answer.data.items.map((sections) => sections[0].location.split("#")[0]);
  console.log(`"${question}": ${wanted} is page ${all.indexOf(wanted) + 1} of ${all.length}; the first are ${pages.join(", ")}`);
}
console.log(`${kQuestions.length - failed} of ${kQuestions.length} questions find their page`);
process.exit(failed ? 1 : 0);
