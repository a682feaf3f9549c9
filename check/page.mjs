// Draws what the page in examples/hosts/web draws, with each technique and storage, on the Vulkan driver that VK_DRIVER_FILES names.
//
// usage: node --import ./check/import_map.mjs check/page.mjs
// Every technique has to shadow about what percentage-closer filtering does.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { create, globals } from 'webgpu';

Object.assign(globalThis, globals);

const folder = fileURLToPath(new URL('../examples/hosts/web', import.meta.url));
const SIZE = [256, 144];
// The camera before the scene, the sun from the side; both halves are recorded.
const LOOK = { eye: [7, 6, 8], angle: 2.1, split: 0.5, size: 0.05 };
// Of the blur, in texels.
const RADIUS = 3;
// Of shadow intensity, over the picture. Light leaks where techniques are weak, and the soft ones have penumbrae.
const LARGEST_MEAN_DIFFERENCE = 0.025;

// Kept: adapters end with it.
const gpu = create(['backend=vulkan']);

const read = (name) => JSON.parse(readFileSync(join(folder, 'plans', name), 'utf8'));

// The channel of a texture, from 0 to 1.
async function contents(device, texture) {
  const bytesPerRow = Math.ceil(SIZE[0] / 256) * 256;
  const buffer = device.createBuffer({ size: bytesPerRow * SIZE[1], usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, SIZE);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  return Array.from(new Uint8Array(buffer.getMappedRange()), (value) => value / 255);
}

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

async function main() {
  const { Renderer } = await import('../examples/hosts/web/renderer.js');
  const adapter = await gpu.requestAdapter();
  if (!adapter) throw new Error('Dawn finds no Vulkan adapter; name a driver in VK_DRIVER_FILES, such as SwiftShader');
  const device = await adapter.requestDevice();
  const faults = [];
  device.addEventListener('uncapturederror', ({ error }) => faults.push(error.message));
  const format = 'rgba8unorm';
  const renderer = new Renderer(device, format);
  const picture = device.createTexture({ size: SIZE, format, usage: GPUTextureUsage.RENDER_ATTACHMENT });
  const { plans: all, references } = read('index.json');
  const plans = all.filter(({ radius }) => [null, RADIUS].includes(radius));
  // As a page does whose canvas gets its size late.
  await renderer.resize(64, 64);
  await renderer.take('reference', read(references[RADIUS]), { map: 'light_depth' });
  await renderer.resize(...SIZE);
  for (const { file, technique, storage, map } of plans) {
    await renderer.take('chosen', read(file), { map });
    renderer.draw(picture.createView(), LOOK);
    const [chosen, expected] = [await contents(device, renderer.chosen.intensity), await contents(device, renderer.reference.intensity)];
    const difference = mean(chosen.map((value, index) => Math.abs(value - expected[index])));
    console.log(`${technique}, ${storage}: ${mean(chosen).toFixed(4)} in shadow, ${difference.toFixed(4)} from the reference`);
    if (!(mean(expected) > 0.02 && mean(expected) < 0.5)) faults.push(`the reference has ${mean(expected)} in shadow`);
    if (difference > LARGEST_MEAN_DIFFERENCE) faults.push(`${file} is ${difference} from the reference`);
  }
  for (const fault of faults) console.error(fault);
  console.log(`the page: ${plans.length} plans drawn, ${faults.length} faults`);
  return faults.length === 0 && plans.length > 0;
}

main().then(
  // An open device keeps the process alive.
  (passed) => process.exit(passed ? 0 : 1),
  (error) => {
    console.error(error.message);
    process.exit(1);
  },
);
