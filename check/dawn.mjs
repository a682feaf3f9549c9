// Dawn, the WebGPU of Chromium with its compiler Tint, on the null backend, which needs no adapter: opens devices and
// judges shaders.

import { create, globals } from 'webgpu';
import { pipelines } from './pipelines.mjs';

Object.assign(globalThis, globals);

const gpu = create(['backend=null']);

// A device with the limits that every device has, and with `requiredFeatures` and no others.
export async function openDevice(requiredFeatures = []) {
  // An adapter gives one device only.
  const adapter = await gpu.requestAdapter();
  return adapter.requestDevice({ requiredFeatures });
}

// Runs `work` and gives its result with whatever the device objects to.
async function scoped(device, work) {
  const scopes = ['validation', 'internal'];
  for (const scope of scopes) device.pushErrorScope(scope);
  let result;
  const objections = [];
  try {
    result = await work();
  } catch (error) {
    objections.push(error.message);
  }
  for (const _ of scopes) {
    const error = await device.popErrorScope();
    if (error) objections.push(error.message);
  }
  return [result, objections];
}

// Compiles a text and makes a pipeline of each of `entryPoints` (see pipelines.mjs). Gives every objection. Messages of
// the compiler that are of one of `types` are objections.
export async function judge(device, code, entryPoints, constants, types = ['error', 'warning']) {
  const [module, objections] = await scoped(device, () => device.createShaderModule({ code }));
  const { messages } = await module.getCompilationInfo();
  const spoken = messages
    .filter(({ type }) => types.includes(type))
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
