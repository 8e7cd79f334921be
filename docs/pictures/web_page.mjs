// node web_page.mjs URL PICTURE ROBOT TICK COMMAND...: opens the page of web_render, selects a robot, has the command bring
// the run to the tick, and takes a picture. Used by docs/pictures/make. Environment: PAGE_MODULES.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.env.PAGE_MODULES, "here.js"))("playwright-core");
const [url, picture, robot, tick, ...command] = process.argv.slice(2);

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.setDefaultTimeout(120000);
await page.goto(`${url}#quality=high`); // in three dimensions, though this browser has no graphics card
await page.waitForFunction(() => window.swarmanoid?.drawn > 0);
await page.evaluate((id) => {
  swarmanoid.show("trails", true);
  swarmanoid.select(id);
}, robot);
await page.waitForTimeout(5000); // until the arena fits between the panels
// A drag turns the view to where the robot does not hide its prey, the wheel leaves room for what turns with it.
await page.mouse.move(620, 640);
await page.mouse.down();
await page.mouse.move(576, 640, { steps: 8 });
await page.mouse.up();
await page.mouse.wheel(0, 60);
spawn(command[0], command.slice(1), { stdio: "inherit" });
await page.waitForFunction((last) => swarmanoid.tick === last, Number(tick), { timeout: 600000 });
await page.waitForTimeout(3000);
await page.screenshot({ path: picture });
await browser.close();
