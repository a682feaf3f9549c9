// Drives both pages of examples/hosts/web in headless Chromium, on its software adapter SwiftShader.
//
// usage: node --import ./check/import_map.mjs check/browser/browser.mjs FOLDER MOMENT_SHADOWS WEB_PAGE [CHECK...]
// FOLDER takes screenshots. Without a CHECK all of them run. The pages are served by their own command, with the program MOMENT_SHADOWS; WEB_PAGE is the example that draws
// the picture of the page without a browser.

import { mkdirSync, rmSync } from 'node:fs';
import { resolve } from 'node:path';
import { launch } from './chromium.mjs';
import { controls } from './controls.mjs';
import { loading } from './loading.mjs';
import { natively } from './native.mjs';
import { phone } from './phone.mjs';
import { serve } from './serve.mjs';
import { troubles } from './troubles.mjs';

const CHECKS = { controls, natively, phone, troubles, loading };

async function main(folder, command, native, names) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const server = await serve(command);
  const browser = await launch();
  const faults = [];
  const tell = { folder, browser, ...server, native, fault: (message) => faults.push(message) && console.error(message) };
  try {
    for (const name of names) {
      const start = performance.now();
      await CHECKS[name](tell).catch((error) => tell.fault(`${name}: ${error.message}`));
      console.log(`${name}: ${((performance.now() - start) / 1000).toFixed(1)} s`);
    }
  } finally {
    await browser.close();
    server.stop();
  }
  console.log(`two pages in ${browser.version()}: ${faults.length} faults; the pictures are in ${folder}`);
  return faults.length === 0;
}

const [paths, names] = [process.argv.slice(2, 5), process.argv.slice(5)];
const unknown = names.find((name) => !(name in CHECKS));
if (paths.length < 3 || unknown !== undefined) {
  if (unknown !== undefined) console.error(`there is no check '${unknown}'`);
  console.error(`usage: browser.mjs FOLDER MOMENT_SHADOWS WEB_PAGE [${Object.keys(CHECKS).join('|')}]...`);
  process.exit(2);
}
const passed = await main(...paths.map((path) => resolve(path)), names.length > 0 ? names : Object.keys(CHECKS));
process.exitCode = passed ? 0 : 1;
