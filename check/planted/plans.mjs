// Faults that are planted in a plan or in its use, with words of the message that has to say so; and what has to work.

import assert from 'node:assert/strict';
import { createRecorder } from '../../graph/js/recorder.js';
import { resized } from '../../graph/js/resize.js';
import { makeImports } from '../plan_imports.mjs';
import { outOfMemoryAt } from './failing_device.mjs';

// The binding of a pass of examples/hard_shadows.json.
const binding = (plan, node, name) => plan.passes.find((pass) => pass.node === node).bindings.find((it) => it.name === name);
const memory = (plan, label) => plan.memory.find((it) => it.label.startsWith(label));
const encoder = (device) => device.createCommandEncoder();

// The imports of a plan with one of another size.
function sized(device, plan, name, size) {
  const other = structuredClone(plan);
  other.resources.find((resource) => resource.name === name).desc.texture.size = size;
  return makeImports(device, other);
}

export const PLANTED = [
  {
    name: 'sample type',
    words: 'TextureSampleType::Uint',
    change: (plan) => {
      binding(plan, 'resolve', 'depth_map').layout.texture.sampleType = 'uint';
    },
  },
  {
    name: 'filterable sample type of depth',
    words: 'TextureSampleType::Float',
    change: (plan) => {
      binding(plan, 'shade', 'camera_depth').layout.texture.sampleType = 'float';
    },
  },
  {
    name: 'format of a storage texture',
    words: 'TextureFormat::RGBA32Float',
    change: (plan) => {
      binding(plan, 'blur', 'written_map').layout.storageTexture.format = 'rgba32float';
    },
  },
  {
    name: 'format of memory that is drawn to',
    words: 'R16Float',
    change: (plan) => {
      memory(plan, 'shade').desc.texture.format = 'r16float';
    },
  },
  {
    name: 'format of memory that is stored to',
    words: 'RGBA32Float',
    change: (plan) => {
      memory(plan, 'blur.half').desc.texture.format = 'rgba32float';
    },
  },
  {
    name: 'usage',
    words: 'StorageBinding',
    change: (plan) => {
      memory(plan, 'resolve').usage = ['TEXTURE_BINDING'];
    },
  },
  {
    name: 'size of a uniform',
    words: 'minBindingSize (16)',
    change: (plan) => {
      binding(plan, 'shade', 'views').layout.buffer.minBindingSize = 16;
    },
  },
  {
    name: 'dynamic offset',
    words: 'dynamic offset',
    change: (plan) => {
      plan.passes[0].dynamic_offsets.pop();
    },
  },
  {
    name: 'syntax of a shader',
    words: 'fnn texel_to_texture',
    change: (plan) => {
      plan.shaders[0] = plan.shaders[0].replace('fn ', 'fnn ');
    },
  },
  {
    name: 'version',
    words: 'version 2',
    change: (plan) => {
      plan.version = 2;
    },
  },
  {
    name: 'feature',
    words: "requiredFeatures: ['float32-filterable']",
    change: (plan) => {
      plan.device.features = ['float32-filterable'];
    },
  },
  {
    name: 'feature that only wgpu has',
    words: 'which no browser has',
    change: (plan) => {
      plan.device.wgpu_features = ['texture-format-16-bit-norm'];
    },
  },
  {
    name: 'limit',
    words: 'requiredLimits: { maxTextureArrayLayers: 4096 }',
    change: (plan) => {
      plan.device.limits.maxTextureArrayLayers = 4096;
    },
  },
  {
    name: 'import that is missing',
    words: "import 'camera_depth' is missing",
    change: (plan, device) => ({ ...makeImports(device, plan), camera_depth: undefined }),
  },
  {
    name: 'import of another format',
    words: "import 'camera_depth' has the format depth16unorm",
    change: (plan, device) => {
      const other = structuredClone(plan);
      other.resources[1].desc.texture.format = 'depth16unorm';
      return makeImports(device, other);
    },
  },
  {
    name: 'size beyond the device',
    words: 'maxTextureDimension2D',
    use: (recorder) => recorder.resize(sized(wide(), recorder.plan, 'camera_depth', [9000, 16])),
  },
  {
    name: 'size below the kernel',
    words: '9 along each side are the fewest',
    use: (recorder, device) => recorder.resize(sized(device, recorder.plan, 'light_depth', [64, 8])),
  },
  {
    name: 'layer',
    words: 'layer 1 is marked dirty',
    use: (recorder, device) => recorder.record('after_shadow_maps', encoder(device), { layers: [1] }),
  },
  {
    name: 'map',
    words: "no pass follows a map 'sun'",
    use: (recorder, device) => recorder.record('after_shadow_maps', encoder(device), { layers: { sun: [0] } }),
  },
  {
    name: 'stage',
    words: "no stage 'later'",
    use: (recorder, device) => recorder.record('later', encoder(device)),
  },
  {
    name: 'offset',
    words: 'cannot begin at byte 128',
    use: (recorder, device) => recorder.record('after_shadow_maps', encoder(device), { offset: 128 }),
  },
  {
    name: 'output',
    words: "no output 'light'",
    use: (recorder) => recorder.output('light'),
  },
];

// Textures of any size: for recorders, which look at no more than what a texture says of itself.
const wide = () => ({
  createTexture: ({ size: [width, height], ...desc }) => ({ ...desc, width, height, depthOrArrayLayers: 1, mipLevelCount: 1 }),
});

// The plan with a pass that the host draws.
function withHostPass(plan) {
  const pass = plan.passes.at(-1);
  Object.assign(pass, { shader: null, entry_point: '', vertex_entry_point: null, visibility: null, bindings: [], dynamic_offsets: [] });
  const { target } = pass.work.fullscreen;
  pass.work = { host: { targets: [target], blend: true, depth: null } };
  return plan;
}

export const HANDLED = {
  'a size without the mip levels of a plan': async (device, plan) => {
    const map = plan.resources.find(({ name }) => name === 'blur.blurred').desc.texture;
    map.mips = 11;
    resized(plan, { light_depth: [1024, 1500] });
    assert.throws(() => resized(plan, { light_depth: [1023, 1500] }), /'blur.blurred' has 11 mip levels; 1023x1500 texels have 10/);
  },
  'ranges of more regions than a depth map has tiles': async (device, plan) => {
    const { texture } = plan.resources.find(({ name }) => name === 'blur.blurred').desc;
    const made = (name, size, more) => {
      return { name, home: {}, extent: null, desc: { texture: { ...texture, mips: 1, size, ...more } } };
    };
    const light = plan.imports.findIndex(({ name }) => name === 'light_depth');
    const ends = { ...made('fit.ends', [32, 32]), extent: { import: light, per: [32, 32] } };
    plan.resources.push(made('fit.ranges', [9, 1], { range: 'fit.ranges' }), ends);
    resized(plan, { light_depth: [96, 96] });
    assert.throws(() => resized(plan, { light_depth: [64, 128] }), /node 'fit' fits ranges of 9 regions, more than the 2x4 tiles/);
  },
  'a pass of the host': async (device, plan) => {
    const recorder = await createRecorder(device, withHostPass(plan), makeImports(device, plan));
    assert.throws(() => recorder.record('after_main_pass', encoder(device)), /the host's pass 'shade\/shade'/);
    const drawn = [];
    device.pushErrorScope('validation');
    const commands = encoder(device);
    const hostPass = ({ name, layer, targets, depth, blend }, encoder) => {
      drawn.push([name, layer, targets.length, depth, blend]);
      encoder.beginRenderPass({ colorAttachments: [{ view: targets[0], loadOp: 'clear', storeOp: 'store' }] }).end();
    };
    recorder.record('after_main_pass', commands, { hostPass });
    commands.finish();
    assert.equal(await device.popErrorScope(), null);
    assert.deepEqual(drawn, [['shade/shade', 0, 1, undefined, true]]);
  },
  'a bind group above the host\'s': async (device, plan) => {
    plan.bind_group = 2;
    plan.device.limits.maxBindGroups = 3;
    plan.shaders = plan.shaders.map((text) => text.replaceAll('@group(0)', '@group(2)').replaceAll('const GROUP = 0;', 'const GROUP = 2;'));
    const recorder = await createRecorder(device, plan, makeImports(device, plan));
    device.pushErrorScope('validation');
    const commands = encoder(device);
    for (const stage of ['after_shadow_maps', 'after_main_pass']) recorder.record(stage, commands);
    commands.finish();
    assert.equal(await device.popErrorScope(), null);
  },
  'views of a buffer of the host': async (device, plan) => {
    const parameters = device.createBuffer({ size: 2 * plan.parameters.size, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    const recorder = await createRecorder(device, plan, makeImports(device, plan), { parameters });
    recorder.record('after_main_pass', encoder(device), { offset: plan.parameters.size });
    assert.throws(() => recorder.record('after_main_pass', encoder(device), { offset: 2 * plan.parameters.size }), /cannot begin/);
  },
  'no memory for any of the calls': async (device, plan) => {
    const imports = makeImports(device, plan);
    const tell = async (at) => {
      const [failing, state] = outOfMemoryAt(device, at);
      const errors = [];
      const noted = (error) => void errors.push(error.message);
      const recorder = await createRecorder(failing, plan, imports).catch(noted);
      // What could not be replaced works on.
      await recorder?.resize(imports).catch(noted);
      recorder?.record('after_main_pass', encoder(device));
      recorder?.destroy();
      recorder?.parameters.destroy();
      return { ...state, errors };
    };
    const { calls, errors, said } = await tell(-1);
    assert.deepEqual([errors, said], [[], []]);
    assert.ok(calls > 30, `${calls} calls`);
    for (let at = 0; at < calls; at++) {
      const { errors, said, alive } = await tell(at);
      assert.equal(errors.length, 1, `call ${at}: ${errors}`);
      assert.match(errors[0], /cannot be made: no memory for/);
      assert.deepEqual([said, alive.size], [[], 0], `call ${at}, ${errors}`);
    }
  },
};
