// Drives the page in Chromium: `node drive.mjs CHROMIUM URL JOB.json`; prints as JSON what there was to see.
// A job: {folders: [...], shots: FOLDER or null, widths: [...]}: each folder is looked at, one after the other.
import { readFileSync } from "node:fs";
import { chromium } from "playwright-core";

const [executablePath, url, file] = process.argv.slice(2);
const job = JSON.parse(readFileSync(file, "utf8"));
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update"],
});
const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
const told = { console: [], requests: [], machines: [] };
page.on("console", (message) => told.console.push(message.text()));
page.on("pageerror", (error) => told.console.push(String(error)));
page.on("request", (request) => told.requests.push([request.method(), request.url()]));
page.setDefaultTimeout(180_000);
await page.goto(url);
await page.waitForSelector("body.ready");
await page.waitForSelector("#native.good, #native.bad");
told.native = await page.textContent("#native");

const text = (selector) => page.$$eval(selector, (found) => found.map((one) => one.textContent));

/** Drop a folder as a hand does. */
async function dropped(folder) {
  const session = await page.context().newCDPSession(page);
  await page.evaluate(() => scrollTo(0, 0));
  const box = await page.locator("#drop").boundingBox();
  const data = { items: [], files: [folder], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await session.send("Input.dispatchDragEvent", { type, x: box.x + 20, y: box.y + 20, data });
  }
}

for (const folder of job.folders) {
  await page.evaluate(() => document.getElementById("result").replaceChildren());
  if (job.drop === folder) await dropped(folder);
  else await page.setInputFiles(folder.endsWith(".lis") ? "#files" : "#folder", folder);
  await page.waitForFunction(() => document.querySelector("#findings") !== null && !document.body.matches(".busy"));
  const more = page.locator("#findings button");
  if ((await more.count()) > 0) await more.click();
  const seen = {
    summary: await page.textContent("#findings .lead"),
    findings: await page.$$eval("#findings tbody tr", (rows) => rows.map((row) => {
      const [severity, place, code, message] = row.children;
      return [severity.textContent, place.textContent, code.querySelector("summary").textContent, message.textContent];
    })),
    tables: await text("#tables h3"),
    judged: await text("#judgement li"),
    limits: await text("#judgement tbody tr"),
    status: await page.textContent("#status"),
  };
  if ((await page.locator("#move input[type=range]").count()) > 0) {
    await page.waitForSelector("#python.good, #python.bad");
    seen.python = await page.textContent("#python");
    // By a hand: to a third of the range, then on.
    for (const share of [0.33, 0.7]) {
      await page.$$eval("#move input[type=range]", (sliders, part) => {
        for (const slider of sliders) slider.value = Number(slider.min) + part * (slider.max - slider.min);
      }, share);
      await page.waitForTimeout(1500);
    }
    await page.locator("#move select[aria-label=Feed]").selectOption("500");
    await page.waitForFunction(() => [...document.querySelectorAll("#move .axis")].every((axis) => {
      const number = (output) => Number(output.textContent.split(" ")[0].replace("−", "-"));
      const [setpoint] = axis.querySelectorAll(".positions output");
      return Math.abs(number(setpoint) - Number(axis.querySelector("input").value)) < 1e-3;
    }));
    await page.waitForTimeout(300);
    seen.moved = await page.$$eval("#move .axis", (axes) => axes.map((axis) => ({
      target: Number(axis.querySelector("input").value),
      positions: [...axis.querySelectorAll(".positions output")].map((one) => one.textContent),
      values: Object.fromEntries([...axis.querySelectorAll(".value")].map((line) =>
        [line.querySelector(".kind").textContent, line.querySelector("output").textContent])),
    })));
  }
  if (job.shots) {
    for (const width of job.widths) {
      await page.setViewportSize({ width, height: 900 });
      await page.evaluate(() => scrollTo(0, 0));
      await page.waitForTimeout(300);
      const name = folder.split("/").pop();
      await page.screenshot({ path: `${job.shots}/${name}-${width}.png`, fullPage: true });
      seen[`overflow${width}`] = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
    }
    await page.setViewportSize({ width: 1200, height: 900 });
  }
  told.machines.push(seen);
}
await browser.close();
console.log(JSON.stringify(told));
