// The first drag in Firefox, and what the page says where nothing can be drawn. Needs a display.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { serve } from '../serve.mjs';

const live = join(dirname(fileURLToPath(import.meta.url)), '../../../../build/live');
const puppeteer = (
  await import(pathToFileURL(createRequire(join(live, 'x.js')).resolve('puppeteer-core')))
).default;
const { server, address } = await serve(join(live, 'page'));

async function inFirefox(prefs, f) {
  const browser = await puppeteer.launch({
    browser: 'firefox',
    executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
    headless: false,
    extraPrefsFirefox: prefs,
  });
  const page = await browser.newPage();
  await page.setViewport({ width: 1000, height: 700 });
  await page.goto(address);
  await f(page, await browser.version());
  await browser.close();
}

await inFirefox({ 'webgl.force-enabled': true }, async (page, version) => {
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.evaluate(() => window.arap.ready);
  const settled = () =>
    page.waitForFunction(() => window.arap.state()?.isSettled, { timeout: 60000 });
  await settled();
  const {
    screen: [x, y],
  } = await page.evaluate(() => window.arap.state().handles[0]);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 10; ++k) await page.mouse.move(x + 12 * k, y + 4 * k);
  await page.mouse.up();
  await settled();
  assert((await page.evaluate(() => window.arap.state().energy)) > 1e-4, 'it follows');
  assert(
    (await page.evaluate(() => window.arap.distanceToTargets())) < 1e-6,
    'the handle is at its target',
  );
  await page.screenshot({ path: join(live, 'screenshots/21_firefox.png') });
  assert.deepEqual(complaints, []);
  console.log(`${version}: well`);
});
await inFirefox({ 'webgl.disabled': true }, async (page) => {
  await page.waitForFunction(() => !document.querySelector('#message').hidden, { timeout: 20000 });
  assert.match(await page.$eval('#message', (m) => m.innerText), /WebGL/);
});
server.close();
