// How long it takes from the beginning of the navigation to the first frame, and to the first one with all that it compares, from a server
// on this machine, with nothing in the browser's cache. Printed, and not held: times are those of the machine.

import { drawn, open } from './chromium.mjs';

const LOADS = 5;

const seconds = (milliseconds) => (milliseconds / 1000).toFixed(2);
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

export async function loading({ browser, ...addresses }) {
  for (const at of ['techniques', 'three']) {
    const loads = [];
    for (let load = 0; load < LOADS; load++) {
      const page = await open(browser, addresses[at]);
      await drawn(page);
      const marks = await page.evaluate(() => performance.getEntriesByName('drawn').map(({ startTime }) => startTime));
      loads.push([marks[0], marks.at(-1)]);
      await page.context().close();
    }
    const [first, whole] = [0, 1].map((index) => seconds(median(loads.map((load) => load[index]))));
    const all = loads.map((load) => load.map(seconds).join(' and '));
    console.log(`${at}: a frame after ${first} s, a whole one after ${whole} s, the medians of ${LOADS}: ${all.join(', ')}`);
  }
}
