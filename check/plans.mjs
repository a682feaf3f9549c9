// Records plans by the recorder in JavaScript, graph/js, on Dawn's null backend, which validates everything and runs nothing.
//
// usage: node plans.mjs FOLDER
// FOLDER is what the example `write_plans` wrote: a folder per profile. Each plan is recorded on a device with the features of its
// profile and no others: all layers, some layers, and after its imports have changed their size, which has to give the plan that the
// compiler makes for that size. Faults that are planted on purpose come first: a check that does not see them proves nothing.

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { isDeepStrictEqual } from 'node:util';
import { createRecorder } from '../graph/js/recorder.js';
import { resized } from '../graph/js/resize.js';
import { command } from './command.mjs';
import { openDevice } from './dawn.mjs';
import { makeImports, sizesOfPlan } from './plan_imports.mjs';
import { HANDLED, PLANTED } from './planted/plans.mjs';

// What a device of each profile has, by WebGPU's names. A profile without a folder is left out, but for the first.
const PROFILES = {
  'webgpu-core': [],
  'webgpu-tier1': ['texture-formats-tier1'],
  native: ['texture-formats-tier1'],
  'native-adapter': ['texture-formats-tier1', 'texture-formats-tier2'],
};

const STAGES = ['after_shadow_maps', 'after_main_pass'];

// What a host draws: nothing, to targets that keep what they hold.
function hostPass({ targets }, encoder) {
  encoder.beginRenderPass({ colorAttachments: targets.map((view) => ({ view, loadOp: 'load', storeOp: 'store' })) }).end();
}

// Records both stages, all layers and then some of them, and submits them.
async function recordAll(device, recorder) {
  device.pushErrorScope('validation');
  const encoder = device.createCommandEncoder();
  const first = Object.fromEntries(recorder.plan.passes.map(({ map }) => [map, [0]]));
  for (const layers of [undefined, [0], first, {}]) {
    for (const stage of STAGES) recorder.record(stage, encoder, { layers, hostPass });
  }
  device.queue.submit([encoder.finish()]);
  const error = await device.popErrorScope();
  if (error) throw new Error(error.message);
}

// Notes which mip levels of which layers of a texture are viewed alone: for each texture that the device makes meanwhile.
function watchViews(device) {
  const watched = [];
  const unwatched = device.createTexture;
  device.createTexture = (desc) => {
    const texture = unwatched.call(device, desc);
    const parts = new Set();
    const createView = texture.createView.bind(texture);
    texture.createView = (view) => {
      if (view.dimension === '2d') parts.add(`level ${view.baseMipLevel} of layer ${view.baseArrayLayer}`);
      return createView(view);
    };
    watched.push({ desc, parts });
    return texture;
  };
  const stop = () => delete device.createTexture;
  return [watched, stop];
}

// Every level of every layer of what the plan makes is written by some pass: planes and layers lie where they should.
function checkParts(watched) {
  for (const { desc, parts } of watched) {
    const expected = (desc.mipLevelCount ?? 1) * desc.size[2];
    if (parts.size === expected) continue;
    throw new Error(`of '${desc.label}' ${parts.size} parts are viewed, it has ${expected}: ${[...parts].join(', ')}`);
  }
}

async function recordPlan(device, plan, other) {
  const imports = makeImports(device, plan);
  const [watched, stop] = watchViews(device);
  const recorder = await createRecorder(device, plan, imports).finally(stop);
  checkParts(watched);
  await recordAll(device, recorder);
  // Bytes that are moved are figures for people, which nothing is recorded by.
  const compared = (plan) => ({ ...plan, passes: plan.passes.map((pass) => ({ ...pass, bytes_read: 0, bytes_written: 0 })) });
  const followed = resized(plan, sizesOfPlan(other));
  if (!isDeepStrictEqual(compared(followed), compared(other))) {
    throw new Error(`resized, it is another plan than the compiler's: ${firstDifference(compared(followed), compared(other))}`);
  }
  await recorder.resize(makeImports(device, other));
  await recordAll(device, recorder);
  recorder.destroy();
}

function firstDifference(found, expected, path = 'plan') {
  if (typeof found !== 'object' || typeof expected !== 'object' || !found || !expected) return `${path} is ${found}, not ${expected}`;
  const key = Object.keys({ ...found, ...expected }).find((key) => !isDeepStrictEqual(found[key], expected[key]));
  return firstDifference(found[key], expected[key], `${path}.${key}`);
}

async function checkPlanted(folder) {
  const text = readFileSync(join(folder, 'webgpu-core', 'example hard_shadows.json'), 'utf8');
  for (const { name, words, change, use } of PLANTED) {
    const device = await openDevice();
    const plan = JSON.parse(text);
    let said = '';
    try {
      const imports = change?.(plan, device) ?? makeImports(device, plan);
      const recorder = await createRecorder(device, plan, imports);
      if (use) await use(recorder, device);
      await recordAll(device, recorder);
    } catch (error) {
      said = error.message;
    }
    if (!said.includes(words)) {
      throw new Error(`planted ${name}: it should be refused with the words '${words}'; said is '${said || 'nothing'}'`);
    }
    console.log(`planted ${name}: refused, as it should be`);
  }
  for (const [name, check] of Object.entries(HANDLED)) {
    await check(await openDevice(), JSON.parse(text));
    console.log(`${name}: as it should be`);
  }
}

async function main(folder) {
  await checkPlanted(folder);
  let refused = 0;
  for (const [profile, features] of Object.entries(PROFILES)) {
    const plans = join(folder, profile);
    if (!existsSync(plans)) {
      if (profile === 'webgpu-core') throw new Error(`there are no plans in ${plans}`);
      continue;
    }
    const device = await openDevice(features);
    // Whatever no scope has caught is an objection as well.
    const uncaught = [];
    device.addEventListener('uncapturederror', ({ error }) => uncaught.push(error.message));
    const names = readdirSync(plans).filter((name) => name.endsWith('.json'));
    let [recorded, native] = [0, 0];
    for (const name of names) {
      const [plan, other] = [plans, join(plans, 'resized')].map((at) => JSON.parse(readFileSync(join(at, name), 'utf8')));
      const objections = [];
      try {
        await recordPlan(device, plan, other);
        recorded += 1;
      } catch (error) {
        // What only wgpu has a feature for has to be refused by name, and nothing else.
        const [feature] = plan.device.wgpu_features;
        if (feature && error.message.includes(feature)) native += 1;
        else objections.push(error.message);
      }
      objections.push(...uncaught.splice(0));
      for (const objection of objections) console.error(`${profile}, ${name}: ${objection}\n`);
      refused += objections.length > 0;
    }
    const beyond = native > 0 ? `, ${native} refused that need what only wgpu has` : '';
    console.log(`${profile}: ${recorded} of ${names.length} plans recorded${beyond}`);
    if (recorded < 20) throw new Error(`only ${recorded} plans of ${profile} were recorded`);
  }
  console.log(`${refused} plans refused that should be recorded`);
  return refused === 0;
}

await command('node plans.mjs FOLDER', main);
