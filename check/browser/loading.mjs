// How long it takes from the beginning of the navigation to the first frame that is drawn, from a server on this machine, with nothing
// in the browser's cache. Printed, and not held: times are those of the machine.

import { drawn, open } from './chromium.mjs';

const LOADS = 5;

export async function loading({ browser, ...addresses }) {
  for (const at of ['techniques', 'three']) {
    const times = [];
    for (let load = 0; load < LOADS; load++) {
      const page = await open(browser, addresses[at]);
      await drawn(page);
      times.push(await page.evaluate(() => performance.getEntriesByName('drawn')[0].startTime));
      await page.context().close();
    }
    times.sort((a, b) => a - b);
    console.log(
      `${at}: loads in ${(times[LOADS >> 1] / 1000).toFixed(2)} s, the median of ${LOADS}, from ${times.map((time) => (time / 1000).toFixed(2)).join(', ')}`,
    );
  }
}
