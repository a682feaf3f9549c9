// Every control, by the keyboard alone: reached by Tab, moved by its keys, and then the picture is another one where it should be.

import { join } from 'node:path';
import { open } from './chromium.mjs';
import { difference, picture } from './pictures.mjs';

const LEFT = [0, 0.49];
const RIGHT = [0.51, 1];
const BOTH = [LEFT, RIGHT];

// Of pixels, what a control changes at the least where it acts.
const FEWEST = 0.002;

// Keys, what they change, and whether that is `seen` on either side of the split.
const TECHNIQUES = [
  { id: 'picture', keys: ['ArrowLeft'], says: 'the camera turns', seen: BOTH },
  { id: 'picture', keys: ['ArrowUp'], says: 'the camera rises', seen: BOTH },
  { id: 'picture', keys: ['+', '+'], says: 'the camera comes nearer', seen: BOTH },
  { id: 'angle', keys: ['ArrowRight', 'ArrowRight'], says: 'the sun moves', reads: '160°', seen: BOTH },
  { id: 'radius', keys: ['ArrowRight', 'ArrowRight', 'ArrowRight'], says: 'the blur widens', reads: '6 texels', seen: BOTH },
  { id: 'storage', keys: ['ArrowDown'], says: 'the storage is another', labels: 'hamburger4, float32', seen: [LEFT], fewest: 0 },
  {
    id: 'technique',
    keys: ['ArrowDown', 'ArrowDown', 'ArrowDown'],
    says: 'the technique is another',
    labels: 'evsm4, float32',
    seen: [LEFT],
  },
  { id: 'technique', keys: ['End'], says: 'shadows are soft', labels: 'soft hamburger4, float32', seen: [LEFT] },
  { id: 'size', keys: ['End'], says: 'the sun grows', reads: '6°', seen: [LEFT] },
  { id: 'fog', keys: [' '], says: 'there is fog', seen: BOTH },
  { id: 'density', keys: ['PageUp'], says: 'the fog is denser', reads: /0\.0[7-9]/, seen: BOTH },
  { id: 'anisotropy', keys: ['End'], says: 'the fog scatters forwards', reads: '0.8', seen: BOTH },
  { id: 'fog', keys: [' '], says: 'there is none', seen: BOTH },
  { id: 'split', keys: ['End'], says: 'one technique alone', reads: '100 %', seen: [RIGHT] },
];
const THREE = [
  { id: 'picture', keys: ['ArrowLeft'], says: 'the camera turns', seen: BOTH },
  { id: 'angle', keys: ['ArrowRight', 'ArrowRight'], says: 'the sun moves', reads: '160°', seen: BOTH },
  { id: 'radius', keys: ['ArrowRight', 'ArrowRight', 'ArrowRight'], says: 'the blur widens', reads: '6 texels', seen: BOTH },
  { id: 'filter', keys: ['ArrowUp'], says: 'ours everywhere', seen: [RIGHT] },
  { id: 'filter', keys: ['End'], says: "three.js's own everywhere", seen: BOTH },
];

/** Goes to a control by Tab, from wherever the focus is. */
async function reach(page, id) {
  for (let presses = 0; presses < 20; presses++) {
    const at = await page.evaluate(() => document.activeElement.id);
    if (at === id) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`${id} cannot be reached by Tab`);
}

async function walk({ browser, folder, fault }, name, address, steps) {
  const page = await open(browser, address);
  let before = await picture(page, join(folder, `${name}.png`));
  for (const [index, { id, keys, says, reads, labels, seen, fewest = FEWEST }] of steps.entries()) {
    await reach(page, id);
    for (const key of keys) await page.keyboard.press(key);
    const after = await picture(page, join(folder, `${name}_${String(index + 1).padStart(2, '0')}_${id}.png`));
    const changes = BOTH.map((side) => difference(before, after, side).changed);
    console.log(
      `${name}, ${id} ${keys.join(' ')}: ${says}; ${changes.map((share) => `${(100 * share).toFixed(2)} %`).join(' and ')} of pixels`,
    );
    for (const [side, share] of changes.entries()) {
      const [is, acts] = [['left', 'right'][side], seen.includes(BOTH[side])];
      if (acts && !(share > fewest)) fault(`${name}: ${id} changes ${share} of the pixels on the ${is}`);
      if (!acts && share > 0) fault(`${name}: ${id} changes the ${is} side too, ${share} of its pixels`);
    }
    const said = reads && (await page.locator(`output[for=${id}]`).textContent());
    if (reads && !(reads instanceof RegExp ? reads.test(said) : reads === said)) fault(`${name}: ${id} reads '${said}'`);
    const label = labels && (await page.locator('#line span').first().textContent());
    if (label !== labels) fault(`${name}: the picture is called '${label}', not '${labels}'`);
    before = after;
  }
  await page.waitForFunction(() => /^\d+\.\d ms a frame, /.test(document.getElementById('times').textContent), undefined, {
    timeout: 20_000,
  });
  const unnamed = await page.evaluate(() => {
    const named = (control) => control.labels?.length > 0 || control.getAttribute('aria-label');
    return [...document.querySelectorAll('canvas, input, select, fieldset fieldset')].filter((control) => !named(control)).length;
  });
  if (unnamed > 0) fault(`${name}: ${unnamed} controls have no name`);
  for (const complaint of page.complaints) fault(`${name}: the console has: ${complaint}`);
  await page.context().close();
}

export async function controls(tell) {
  await walk(tell, 'techniques', tell.techniques, TECHNIQUES);
  await walk(tell, 'three', tell.three, THREE);
}
