// node web_page.mjs URL PICTURE ROBOT COMMAND...: opens the page of web_render, selects a robot, has the command let the
// run go on, and takes a picture after its last tick. Used by docs/pictures/make. Environment: PAGE_MODULES.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.env.PAGE_MODULES, "here.js"))("playwright-core");
const [url, picture, robot, ...command] = process.argv.slice(2);

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.setDefaultTimeout(120000);
await page.goto(url);
await page.waitForFunction(() => window.swarmanoid?.drawn > 0);
await page.evaluate((id) => {
  swarmanoid.show("trails", true);
  swarmanoid.select(id);
}, robot);
execFileSync(command[0], command.slice(1));
await page.waitForFunction(() => swarmanoid.phase === "finished");
await page.waitForTimeout(1500);
await page.screenshot({ path: picture });
await browser.close();
