// Pictures, and how they differ.

import { readFileSync } from 'node:fs';
import { setTimeout } from 'node:timers/promises';
import png from 'pngjs';
import { drawn } from './chromium.mjs';

export const read = (file) => png.PNG.sync.read(readFileSync(file));

/** The canvas without what lies over and around it, once it no longer changes. With `path` it is kept. */
export async function picture(page, path) {
  await drawn(page);
  await page.addStyleTag({ content: '#line { visibility: hidden; } #picture { outline: none !important; }' });
  const canvas = page.locator('#picture');
  let before;
  for (let tries = 0; tries < 40; tries++) {
    const bytes = await canvas.screenshot({ path });
    if (before?.equals(bytes)) return png.PNG.sync.read(bytes);
    before = bytes;
    await setTimeout(50);
  }
  throw new Error(`${page.url()} does not come to rest`);
}

/** Differences of two pictures between two columns, given as shares of the width: the mean of 255, and the share of pixels that differ. */
export function difference(a, b, [from, to] = [0, 1]) {
  if (a.width !== b.width || a.height !== b.height) throw new Error(`pictures of ${a.width} x ${a.height} and ${b.width} x ${b.height}`);
  const [first, end] = [Math.round(from * a.width), Math.round(to * a.width)];
  let [sum, changed] = [0, 0];
  for (let y = 0; y < a.height; y++) {
    for (let x = first; x < end; x++) {
      const at = 4 * (y * a.width + x);
      const apart = [0, 1, 2].reduce((total, channel) => total + Math.abs(a.data[at + channel] - b.data[at + channel]), 0);
      sum += apart;
      changed += apart > 0;
    }
  }
  const pixels = a.height * (end - first);
  return { mean: sum / (3 * pixels), changed: changed / pixels };
}
