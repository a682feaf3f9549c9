// Both pages on a phone: nothing scrolls sideways, and every control is on the screen and large enough for a finger.

import { join } from 'node:path';
import { open } from './chromium.mjs';
import { picture } from './pictures.mjs';

const SIZE = [390, 844];

// In CSS pixels: the height of what a finger hits, and of the picture that is left.
const SMALLEST_CONTROL = 24;
const SMALLEST_PICTURE = 300;

// Nothing is wider than the screen, and the canvas has the pixels that are seen.
async function fits(page, name, fault) {
  const { wide, pixels, seen } = await page.evaluate(() => {
    const { width, height, clientWidth, clientHeight } = document.getElementById('picture');
    return { wide: document.documentElement.scrollWidth - innerWidth, pixels: [width, height], seen: [clientWidth, clientHeight] };
  });
  if (wide > 0) fault(`${name}: a phone's screen scrolls sideways by ${wide} pixels`);
  if (String(pixels) !== String(seen)) fault(`${name}: a picture of ${pixels} pixels is shown on ${seen}`);
}

async function look({ browser, folder, fault }, name, address) {
  const page = await open(browser, address, { size: SIZE });
  const { height } = await picture(page);
  await page.screenshot({ path: join(folder, `phone_${name}.png`) });
  if (height < SMALLEST_PICTURE) fault(`${name}: on a phone the picture is ${height} pixels high`);
  await fits(page, name, fault);
  for (const control of await page.locator('select:visible, input:visible, a:visible').all()) {
    const box = await control.boundingBox();
    const id = await control.evaluate((element) => element.id || element.textContent);
    const inside = box.x >= 0 && box.y >= 0 && box.x + box.width <= SIZE[0] && box.y + box.height <= SIZE[1];
    if (!inside) fault(`${name}: ${id} is not on a phone's screen`);
    // What a name belongs to is hit by it too; a link's line is its height.
    if (box.height < SMALLEST_CONTROL && !['fog'].includes(id)) fault(`${name}: ${id} is ${box.height} pixels high`);
  }
  // A finger, or a mouse, turns the camera.
  const before = await picture(page);
  await page.mouse.move(200, 150);
  await page.mouse.down();
  await page.mouse.move(260, 150, { steps: 3 });
  await page.mouse.up();
  const after = await picture(page);
  if (after.data.equals(before.data)) fault(`${name}: dragging does not turn the camera`);
  // On its side, the picture takes the new size.
  await page.setViewportSize({ width: SIZE[1], height: SIZE[0] });
  await page.waitForFunction((height) => document.getElementById('picture').height === height, SIZE[0]);
  await picture(page);
  await page.screenshot({ path: join(folder, `phone_on_its_side_${name}.png`) });
  await fits(page, name, fault);
  for (const complaint of page.complaints) fault(`${name}: on a phone the console has: ${complaint}`);
  await page.context().close();
}

export async function phone(tell) {
  await look(tell, 'techniques', tell.techniques);
  await look(tell, 'three', tell.three);
}
