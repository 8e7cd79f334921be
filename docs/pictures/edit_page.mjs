// node edit_page.mjs URL PICTURE ROBOT: opens the page of `swarmanoid edit`, selects a robot, and takes a picture. Used by
// docs/pictures/make. Environment: PAGE_MODULES.
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.env.PAGE_MODULES, "here.js"))("playwright-core");
const [url, picture, robot] = process.argv.slice(2);

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1200, height: 720 } });
page.setDefaultTimeout(120000);
const address = new URL(url);
address.searchParams.set("quality", "plan");
await page.goto(address.href);
await page.waitForFunction(() => window.swarmanoid?.editor?.form && swarmanoid.drawn > 0);
await page.evaluate((id) => swarmanoid.select(id), robot);
await page.waitForFunction((id) => swarmanoid.editor.form.name === id, robot);
await page.keyboard.press("h");
await page.keyboard.press("Home");
await page.waitForTimeout(2000); // until the arena fits between the panels
await page.screenshot({ path: picture });
await browser.close();
