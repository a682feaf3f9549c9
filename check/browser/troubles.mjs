// What goes wrong is said in words: no WebGPU, no adapter, a lost device, a plan that cannot be fetched.

import { join } from 'node:path';
import { drawn, open } from './chromium.mjs';

const says = (page) => page.locator('#trouble:visible').textContent({ timeout: 20_000 });

// Before the page's scripts.
const withoutWebGpu = (page) => page.addInitScript(() => Reflect.deleteProperty(Navigator.prototype, 'gpu'));
const withoutAdapter = (page) =>
  page.addInitScript(() => {
    GPU.prototype.requestAdapter = async () => null;
  });
const keepingDevice = (page) =>
  page.addInitScript(() => {
    const request = GPUAdapter.prototype.requestDevice;
    GPUAdapter.prototype.requestDevice = async function (...settings) {
      globalThis.device = await request.apply(this, settings);
      return globalThis.device;
    };
  });
const withoutPlans = (page) => page.route('**/plans/**', (route) => route.abort());
const withMissingPlans = (page) => page.route('**/plans/**', (route) => route.fulfill({ status: 404, body: '' }));

const CASES = [
  { name: 'no_webgpu', prepare: withoutWebGpu, words: /no WebGPU.*Chrome/ },
  { name: 'no_adapter', prepare: withoutAdapter, words: /no graphics adapter/ },
  { name: 'lost', prepare: keepingDevice, afterwards: () => globalThis.device.destroy(), words: /was lost.*Reload/ },
  { name: 'no_plans', prepare: withoutPlans, words: /could not be fetched.*Reload/ },
  { name: 'missing_plans', prepare: withMissingPlans, words: /is not there \(404.*Run serve\.mjs/ },
];

export async function troubles({ browser, folder, fault, ...addresses }) {
  // The console has a line of Chromium's own about what could not be loaded.
  const isExpected = (text) => text.startsWith('Failed to load resource');
  for (const at of ['techniques', 'three']) {
    for (const { name, prepare, afterwards, words } of CASES) {
      const page = await open(browser, addresses[at], { prepare, isExpected });
      if (afterwards) {
        await drawn(page);
        await page.evaluate(afterwards);
      }
      const said = await says(page).catch(() => '');
      console.log(`${at}, ${name}: ${said}`);
      if (!words.test(said)) fault(`${at}: with ${name} the page says '${said}'`);
      if (await page.evaluate(() => !document.getElementById('controls').disabled)) fault(`${at}: with ${name} the controls seem to work`);
      await page.screenshot({ path: join(folder, `${name}_${at}.png`) });
      for (const complaint of page.complaints) fault(`${at}: with ${name} the console has: ${complaint}`);
      await page.context().close();
    }
  }
  await oneFails({ browser, fault, ...addresses });
}

// Where one plan of several cannot be had, what was there before stays, and the page goes on.
async function oneFails({ browser, fault, techniques }) {
  const prepare = (page) => page.route('**/plans/evsm4_*.json', (route) => route.abort());
  const page = await open(browser, techniques, { prepare, isExpected: (text) => text.startsWith('Failed to load resource') });
  await drawn(page);
  await page.locator('#technique').selectOption('evsm4');
  const said = await says(page).catch(() => '');
  if (!/evsm4.*could not be fetched/.test(said)) fault(`a technique that cannot be had: the page says '${said}'`);
  if ((await page.locator('#line span').first().textContent()) !== 'hamburger4, float16') fault('a technique that cannot be had is named');
  await page.locator('#technique').selectOption('hamburger6');
  await drawn(page).catch((error) => fault(error.message));
  for (const complaint of page.complaints) fault(`a technique that cannot be had: ${complaint}`);
  await page.context().close();
}
