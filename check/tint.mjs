// Judges shaders by Tint, the WGSL compiler of Chromium, through Dawn's null backend, which needs no adapter.
//
// usage: node tint.mjs FOLDER
// FOLDER is what `moment-shadows-lab shaders --out FOLDER` wrote. Every shader is compiled on a device with the features of
// its profile and no others, and every entry point becomes a pipeline. Errors that are planted on purpose come first: a
// compiler that does not see them proves nothing.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { create, globals } from 'webgpu';

Object.assign(globalThis, globals);

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

// A fragment shader that has no vertex shader beside it and takes nothing but its position.
const FULLSCREEN = `
@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}`;

const gpu = create(['backend=null']);

async function openDevices() {
  const devices = {};
  for (const [profile, requiredFeatures] of Object.entries(FEATURES)) {
    // An adapter gives one device only.
    const adapter = await gpu.requestAdapter();
    devices[profile] = await adapter.requestDevice({ requiredFeatures });
  }
  return devices;
}

// Runs `work` and gives its result with whatever the device objects to.
async function scoped(device, work) {
  device.pushErrorScope('validation');
  let result;
  const objections = [];
  try {
    result = await work();
  } catch (error) {
    objections.push(error.message);
  }
  const error = await device.popErrorScope();
  if (error) objections.push(error.message);
  return [result, objections];
}

// Attributes 0 to 7 of any vertex shader: it takes of each as many components as it declares.
const BUFFERS = [
  {
    arrayStride: 128,
    attributes: Array.from({ length: 8 }, (_, index) => ({ shaderLocation: index, offset: 16 * index, format: 'float32x4' })),
  },
];

// The ways to make a pipeline of an entry point, one of which has to do: a fragment stage fits one of the vertex stages.
function pipelines(device, module, { name: entryPoint, stage, targets }, entryPoints, constants) {
  const stageOf = ({ name }) => ({ module, entryPoint: name, constants, buffers: BUFFERS });
  const layout = 'auto';
  if (stage === 'compute') {
    return [() => device.createComputePipelineAsync({ layout, compute: { module, entryPoint, constants } })];
  }
  if (stage === 'vertex') {
    const depthStencil = { format: 'depth32float', depthWriteEnabled: true, depthCompare: 'less' };
    return [() => device.createRenderPipelineAsync({ layout, vertex: { module, entryPoint, constants, buffers: BUFFERS }, depthStencil })];
  }
  const fragment = { module, entryPoint, constants, targets: targets.map((format) => format && { format }) };
  const vertices = entryPoints.filter(({ stage }) => stage === 'vertex').map(stageOf);
  if (vertices.length === 0) vertices.push({ module: device.createShaderModule({ code: FULLSCREEN }) });
  return vertices.map((vertex) => () => device.createRenderPipelineAsync({ layout, vertex, fragment }));
}

// Compiles a text and makes a pipeline of each of `entryPoints`. Gives every objection; a warning is one.
async function judge(device, code, entryPoints, constants = {}) {
  const [module, objections] = await scoped(device, () => device.createShaderModule({ code }));
  const { messages } = await module.getCompilationInfo();
  const spoken = messages
    .filter(({ type }) => type !== 'info')
    .map(({ type, lineNum, linePos, message }) => `${lineNum}:${linePos}: ${type}: ${message}`);
  if (spoken.length > 0) return spoken;
  if (objections.length > 0) return objections;

  for (const entryPoint of entryPoints) {
    let refused = [];
    for (const make of pipelines(device, module, entryPoint, entryPoints, constants)) {
      [, refused] = await scoped(device, make);
      if (refused.length === 0) break;
    }
    objections.push(...refused.map((reason) => `entry point ${entryPoint.name}: ${reason}`));
  }
  return objections;
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

if (process.argv.length !== 3) {
  console.error('usage: node tint.mjs FOLDER');
  process.exit(2);
}
main(process.argv[2]).then(
  // An open device keeps the process alive.
  (passed) => process.exit(passed ? 0 : 1),
  (error) => {
    console.error(error.message);
    process.exit(1);
  },
);
