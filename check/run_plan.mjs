// Runs a plan for real by the recorder in JavaScript, and compares the picture with arithmetic.
//
// usage: node run_plan.mjs PLAN
// PLAN is that of examples/hard_shadows.json. Dawn runs it on the Vulkan driver that VK_DRIVER_FILES names. The scene is a light straight
// above a ground, and a plate over one half of it, so that under the filter there are two depths: shadow intensity is the share of the
// plate. The light's map and the camera's picture are smaller than the graph file says.

import { readFileSync } from 'node:fs';
import { create, globals } from 'webgpu';
import {
  biasForStoredDepth,
  depthConversion,
  depthPerTexel,
  gaussianKernel,
  initialBlock,
  receiverBias,
  viewParameters,
  write,
} from '../graph/js/parameters.js';
import { createRecorder } from '../graph/js/recorder.js';
import { command } from './command.mjs';

Object.assign(globalThis, globals);

// Kept: adapters end with it.
const gpu = create(['backend=vulkan']);

const MAP = 256;
const [WIDTH, HEIGHT] = [160, 120];
const LARGEST_MEAN_ERROR = 0.001;

// The ground is y = 0 for x and z from -4 to 4, the plate y = 1 for x below 0. Moment depth is -1 at y = 3 and 1 at y = -1.
const LIGHT = [0.25, 0, 0, 0, 0, 0, -0.25, 0, 0, 0.25, 0, 0, 0, 0, 0.75, 1];

// A camera with reversed, infinite depth.
const EYE = [0.7, 2.5, 3.5];
const NEAR = 0.1;
const ZOOM = 1.2;

const sub = (a, b) => a.map((value, axis) => value - b[axis]);
const dot = (a, b) => a.reduce((sum, value, axis) => sum + value * b[axis], 0);
const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay];
const unit = (vector) => vector.map((value) => value / Math.hypot(...vector));
const FORWARD = unit(sub([0.1, 0, 0], EYE));
const RIGHT = unit(cross(FORWARD, [0, 1, 0]));
const UP = cross(RIGHT, FORWARD);

function cameraMatrix() {
  const across = (ZOOM * HEIGHT) / WIDTH;
  const rows = [
    [...RIGHT.map((value) => across * value), -across * dot(RIGHT, EYE)],
    [...UP.map((value) => ZOOM * value), -ZOOM * dot(UP, EYE)],
    [0, 0, 0, NEAR],
    [...FORWARD, -dot(FORWARD, EYE)],
  ];
  return [0, 1, 2, 3].map((column) => rows.map((row) => row[column]));
}

// What a pixel should show: the share of the plate under the filter where its ray meets the ground, divided by what counts as full shadow.
function expected(x, y, shares) {
  const [u, v] = [(2 * (x + 0.5)) / WIDTH - 1, 1 - (2 * (y + 0.5)) / HEIGHT];
  const across = (ZOOM * HEIGHT) / WIDTH;
  const ray = FORWARD.map((value, axis) => value + (u / across) * RIGHT[axis] + (v / ZOOM) * UP[axis]);
  const distance = -EYE[1] / ray[1];
  const [gx, , gz] = EYE.map((value, axis) => value + distance * ray[axis]);
  if (!(distance > 0) || Math.max(Math.abs(gx), Math.abs(gz)) > 4) return 0;
  const texel = (gx / 8 + 0.5) * MAP - 0.5;
  const [first, weight] = [Math.floor(texel), texel - Math.floor(texel)];
  const share = (index) => shares[Math.min(Math.max(index, 0), MAP - 1)];
  return Math.min(((1 - weight) * share(first) + weight * share(first + 1)) / 0.98, 1);
}

const SHADER = `
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
// Two triangles per rectangle: the ground, then the plate.
@vertex fn place(@builtin(vertex_index) index: u32, @builtin(instance_index) plate: u32) -> @builtin(position) vec4f {
    const CORNERS = array(vec2f(0, 0), vec2f(1, 0), vec2f(0, 1), vec2f(0, 1), vec2f(1, 0), vec2f(1, 1));
    let corner = CORNERS[index];
    let x = select(8.0 * corner.x - 4.0, 4.0 * corner.x - 4.0, plate == 1u);
    return clip_from_world * vec4f(x, f32(plate), 8.0 * corner.y - 4.0, 1.0);
}`;

// Draws the ground, and of `rectangles` 2 the plate, into a depth texture.
function draw(device, encoder, texture, matrix, depthCompare, rectangles) {
  const module = device.createShaderModule({ code: SHADER });
  const pipeline = device.createRenderPipeline({
    layout: 'auto',
    vertex: { module },
    depthStencil: { format: texture.format, depthWriteEnabled: true, depthCompare },
    multisample: { count: texture.sampleCount },
  });
  const buffer = device.createBuffer({ size: 64, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
  device.queue.writeBuffer(buffer, 0, new Float32Array(matrix.flat()));
  const depthClearValue = depthCompare === 'less' ? 1 : 0;
  const attachment = { view: texture.createView(), depthClearValue, depthLoadOp: 'clear', depthStoreOp: 'store' };
  const pass = encoder.beginRenderPass({ colorAttachments: [], depthStencilAttachment: attachment });
  pass.setPipeline(pipeline);
  const entries = [{ binding: 0, resource: { buffer } }];
  pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
  pass.draw(6, rectangles);
  pass.end();
}

// Runs the plan, and gives the picture's error: the mean and the largest over `pixels`, of which `dark` are in full shadow and `partly` in
// some.
async function run(device, plan) {
  const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING;
  const depth = (size, sampleCount) => device.createTexture({ format: 'depth32float', size, sampleCount, usage });
  const imports = { light_depth: depth([MAP, MAP], 4), camera_depth: depth([WIDTH, HEIGHT], 1) };
  const recorder = await createRecorder(device, plan, imports);

  const camera = { clipFromWorld: cameraMatrix(), farDepth: 0 };
  const light = { clipFromWorld: LIGHT };
  const conversion = depthConversion({ orthographic: {} });
  const { deviation, size } = recorder.plan.resources.find(({ name }) => name === 'blur.blurred').desc.texture;
  const bias = biasForStoredDepth(receiverBias(deviation, depthPerTexel(light, size)), 'depth32float', conversion);
  const block = initialBlock(plan);
  write(plan, block, 'resolve', 0, conversion);
  write(plan, block, 'shade', 0, viewParameters(camera, light, bias));
  device.queue.writeBuffer(recorder.parameters, 0, block);

  const encoder = device.createCommandEncoder();
  draw(device, encoder, imports.light_depth, [LIGHT], 'less', 2);
  recorder.record('after_shadow_maps', encoder);
  draw(device, encoder, imports.camera_depth, camera.clipFromWorld, 'greater', 1);
  recorder.record('after_main_pass', encoder);
  const bytesPerRow = Math.ceil(WIDTH / 256) * 256;
  const buffer = device.createBuffer({ size: bytesPerRow * HEIGHT, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  encoder.copyTextureToBuffer({ texture: recorder.output('shadow_intensity') }, { buffer, bytesPerRow }, [WIDTH, HEIGHT]);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  const picture = new Uint8Array(buffer.getMappedRange());

  // The share of the plate under the filter, texel by texel.
  const kernel = gaussianKernel(4, 2.4);
  const covered = (index) => (index < MAP / 2 ? 1 : 0);
  const share = (texel) => kernel.reduce((sum, weight, tap) => sum + weight * covered(texel + tap - 4), 0);
  const shares = Array.from({ length: MAP }, (_, texel) => share(texel));
  let [sum, most, dark, partly] = [0, 0, 0, 0];
  for (let y = 0; y < HEIGHT; y++) {
    for (let x = 0; x < WIDTH; x++) {
      const [found, wanted] = [picture[y * bytesPerRow + x] / 255, expected(x, y, shares)];
      sum += Math.abs(found - wanted);
      most = Math.max(most, Math.abs(found - wanted));
      dark += wanted === 1;
      partly += wanted > 0 && wanted < 1;
    }
  }
  recorder.destroy();
  const pixels = WIDTH * HEIGHT;
  return { mean: sum / pixels, most, pixels, dark, partly };
}

async function main(file) {
  const plan = JSON.parse(readFileSync(file, 'utf8'));
  const adapter = await gpu.requestAdapter();
  if (!adapter) throw new Error('Dawn finds no Vulkan adapter; name a driver in VK_DRIVER_FILES, such as SwiftShader');
  const device = await adapter.requestDevice();
  const faults = [];
  device.addEventListener('uncapturederror', ({ error }) => faults.push(error.message));

  // No device objects to a map without regions: only its picture says so.
  const planted = structuredClone(plan);
  for (const table of planted.parameters.regions) table.initial.fill(0);
  const { mean: wrong } = await run(device, planted);
  if (wrong < 10 * LARGEST_MEAN_ERROR) throw new Error(`a map without regions should be seen; the mean error is ${wrong}`);
  console.log(`planted map without regions: mean error ${wrong.toFixed(5)}, seen, as it should be`);

  const { mean, most, pixels, dark, partly } = await run(device, plan);
  for (const fault of faults) console.error(fault);
  const shadows = `${pixels} pixels, ${dark} in shadow, ${partly} partly`;
  console.log(`${adapter.info.description}: ${shadows}; mean error ${mean.toFixed(5)}, largest ${most.toFixed(5)}`);
  return faults.length === 0 && mean < LARGEST_MEAN_ERROR && dark > 1000 && partly > 100;
}

await command('node run_plan.mjs PLAN', main);
