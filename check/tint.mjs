// Judges shaders by Tint, the WGSL compiler of Chromium, through Dawn's null backend, which needs no adapter.
//
// usage: node tint.mjs FOLDER
// FOLDER is what `moment-shadows-lab shaders --out FOLDER` wrote. Every shader is compiled on a device with the features of
// its profile and no others, and every entry point becomes a pipeline. Errors that are planted on purpose come first: a
// compiler that does not see them proves nothing.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { command } from './command.mjs';
import { judge, openDevice } from './dawn.mjs';

// What a profile may rely on, as WebGPU names it.
const FEATURES = {
  'webgpu-core': [],
  native: ['texture-formats-tier1'],
  'native-adapter': ['texture-formats-tier1', 'texture-formats-tier2'],
};

// File, words of the message that belongs to the error, and the entry point to make a pipeline of. All under core WebGPU.
const PLANTED = [
  ['uniformity.wgsl', "'textureSample' must only be called from uniform control flow"],
  ['type.wgsl', 'return statement type must match'],
  ['profile.wgsl', 'RGBA16Unorm', { name: 'clear', stage: 'compute', targets: [] }],
];

async function openDevices() {
  const devices = {};
  for (const [profile, features] of Object.entries(FEATURES)) devices[profile] = await openDevice(features);
  return devices;
}

async function main(folder) {
  const devices = await openDevices();
  const planted = join(dirname(fileURLToPath(import.meta.url)), 'planted');
  for (const [file, words, ...entryPoints] of PLANTED) {
    const code = readFileSync(join(planted, file), 'utf8');
    const objections = await judge(devices['webgpu-core'], code, entryPoints);
    if (!objections.some((objection) => objection.includes(words))) {
      throw new Error(`Tint does not see the error planted in ${file}; it says: ${objections.join('; ') || 'nothing'}`);
    }
    console.log(`planted ${file}: refused, as it should be`);
  }

  const { version, shaders } = JSON.parse(readFileSync(join(folder, 'index.json'), 'utf8'));
  if (version !== 1) throw new Error(`index.json is of version ${version}, not 1`);
  const counts = {};
  let entries = 0;
  let refused = 0;
  for (const { kind, profile, wgsl, constants, entry_points: entryPoints } of shaders) {
    const code = readFileSync(join(folder, wgsl), 'utf8');
    const objections = await judge(devices[profile], code, entryPoints, constants);
    for (const objection of objections) console.error(`${join(folder, wgsl)}:${objection}\n`);
    refused += objections.length > 0;
    counts[kind] = (counts[kind] ?? 0) + 1;
    entries += entryPoints.length;
  }
  const kinds = Object.entries(counts).map(([kind, count]) => `${count} ${kind}`).join(', ');
  console.log(`Tint: ${shaders.length} shaders (${kinds}), ${entries} entry points, ${refused} refused`);
  return refused === 0 && shaders.length > 0;
}

await command('node tint.mjs FOLDER', main);
