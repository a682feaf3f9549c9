// The page's picture beside the one that is drawn without a browser: the same scene, view and graph file by the recorder in Rust, on
// another rasteriser.

import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { SHADER, vertices } from '../../examples/hosts/web/scene.js';
import { Orbit } from '../../examples/hosts/web/orbit.js';
import { view } from '../../examples/hosts/web/view.js';
import { open } from './chromium.mjs';
import { difference, picture, read } from './pictures.mjs';

// Of 255, over the picture. Rasterisers place corners on grids of their own, which is 0.07 to 0.12; a kernel one texel wider is 0.3.
const LARGEST_MEAN = 0.2;

const graph = (name) => {
  const file = new URL(`../../examples/hosts/web/plans/graphs/${name}.json`, import.meta.url);
  return JSON.parse(readFileSync(fileURLToPath(file), 'utf8'));
};

// The graph of the other page, and what its material does, as nodes.
function shadedInThree() {
  const { imports, nodes, edges, ...rest } = graph('three');
  imports.push({ name: 'camera_depth' });
  nodes.push({ name: 'shade', type: 'shade_hard' });
  edges.push({ from: 'blur.blurred', to: 'shade.map' }, { from: 'camera_depth', to: 'shade.camera_depth' });
  return { ...rest, imports, nodes, edges, outputs: [{ name: 'shadow_intensity', from: 'shade.shadow_intensity' }] };
}

// Where the sun is at first.
const ANGLE = 150;

const radians = (degrees) => (degrees * Math.PI) / 180;

// What is chosen on the page, by the keyboard or not, and what it is natively.
const CASES = [
  { name: 'hard', at: 'techniques', set: { split: 100 }, frame: () => ({ graph: graph('hamburger4_float16_3') }) },
  {
    name: 'soft',
    at: 'techniques',
    set: { split: 100, technique: 'soft hamburger4' },
    frame: () => ({ graph: graph('soft_hamburger4_float32'), size_of_sun: radians(3) }),
  },
  {
    name: 'fog',
    at: 'techniques',
    set: { split: 100, fog: true },
    frame: async () => {
      const { FAR, air } = await import('../../examples/hosts/web/air.js');
      return { graph: graph('hamburger4_float16_3'), air: { graph: graph('air'), far: FAR, ...air({ density: 0.06, anisotropy: 0.4 }) } };
    },
  },
  { name: 'pcf', at: 'techniques', set: { split: 0 }, samples: 1, frame: () => ({ graph: graph('pcf_3') }) },
  { name: 'three', at: 'three', set: { filter: 'plan' }, samples: 1, frame: () => ({ graph: shadedInThree() }) },
];

async function choose(page, settings) {
  for (const [id, value] of Object.entries(settings)) {
    const control = page.locator(`#${id}`);
    if (value === true) await control.check();
    else if (typeof value === 'number') await control.fill(String(value));
    else await control.selectOption(value);
  }
}

export async function natively({ browser, folder, native, fault, ...addresses }) {
  const files = [];
  for (const { name, at, set, samples = 4, frame } of CASES) {
    const page = await open(browser, addresses[at]);
    await picture(page);
    await choose(page, set);
    const { width, height } = await picture(page, join(folder, `browser_${name}.png`));
    await page.context().close();
    const { eye } = new Orbit({ addEventListener() {} });
    const { towardsSun, sun, camera } = view({ eye, angle: radians(ANGLE), size: [width, height] });
    const file = join(folder, `native_${name}.json`);
    const scene = { shader: SHADER, vertices: [...vertices()], map: [1024, samples], size: [width, height] };
    writeFileSync(file, JSON.stringify({ ...scene, towards_sun: towardsSun, sun, camera: camera.clipFromWorld, ...(await frame()) }));
    files.push(file);
  }
  execFileSync(native, files, { stdio: 'inherit' });
  for (const { name } of CASES) {
    const [ours, theirs] = ['browser', 'native'].map((where) => read(join(folder, `${where}_${name}.png`)));
    const { mean, changed } = difference(ours, theirs);
    console.log(`${name}: ${mean.toFixed(3)} of 255 between browser and native, ${(100 * changed).toFixed(1)} % of pixels differ`);
    if (!(mean <= LARGEST_MEAN)) fault(`${name}: the browser's picture is ${mean} of 255 from the native one`);
  }
}
