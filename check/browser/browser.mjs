// Drives both pages of examples/hosts/web in headless Chromium, on its software adapter SwiftShader.
//
// usage: node browser.mjs FOLDER MOMENT_SHADOWS WEB_PAGE
// FOLDER takes screenshots. The pages are served by their own command, with the program MOMENT_SHADOWS; WEB_PAGE is the example that draws
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

async function main(folder, command, native) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const server = await serve(command);
  const browser = await launch();
  const faults = [];
  const tell = { folder, browser, ...server, native, fault: (message) => faults.push(message) && console.error(message) };
  try {
    for (const check of [controls, natively, phone, troubles, loading]) {
      const start = performance.now();
      await check(tell);
      console.log(`${check.name}: ${((performance.now() - start) / 1000).toFixed(1)} s`);
    }
  } finally {
    await browser.close();
    server.stop();
  }
  console.log(`two pages in ${browser.version()}: ${faults.length} faults; the pictures are in ${folder}`);
  return faults.length === 0;
}

if (process.argv.length !== 5) {
  console.error('usage: node browser.mjs FOLDER MOMENT_SHADOWS WEB_PAGE');
  process.exit(2);
}
const passed = await main(...process.argv.slice(2).map((path) => resolve(path)));
process.exitCode = passed ? 0 : 1;
