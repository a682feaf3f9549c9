// Records a plan with WebGPU: one file that says everything a recorder has to do. The plan has WebGPU's own names, so nothing is guessed.

import { checkDevice } from './device.js';
import { checkRecording, dirtyLayers } from './dirty_layers.js';
import { scoped } from './error_scopes.js';
import { checkImports, sizesOf } from './imports.js';
import { allocate, bindPass } from './objects.js';
import { initialBlock } from './parameters/block.js';
import { makePipelines } from './pipelines.js';
import { resized } from './resize.js';

/**
 * Makes everything that a plan needs on a device. `imports` has what the host gives, by name: a GPUTexture, a list of one per layer, or
 * a GPUBuffer; sizes follow theirs. `parameters` is a buffer with a block of `plan.parameters.size` bytes per view; without it there is
 * one, for `views` of them, as `recorder.parameters`.
 */
export async function createRecorder(device, plan, imports, { parameters, views = 1 } = {}) {
  checkDevice(device, plan);
  const pipelines = await makePipelines(device, plan);
  // Groups below the plan's are the host's; here they are empty.
  const group = () => device.createBindGroup({ layout: device.createBindGroupLayout({ entries: [] }), entries: [] });
  const empty = await scoped(device, 'an empty group', group);
  const own = parameters ? undefined : await scoped(device, 'the parameters', () => makeParameters(device, plan, views));
  const recorder = new Recorder(device, plan, pipelines, empty, parameters ?? own);
  try {
    await recorder.resize(imports);
    return recorder;
  } catch (error) {
    own?.destroy();
    throw error;
  }
}

// A buffer in which each view has the initial values of the plan's nodes.
function makeParameters(device, plan, views) {
  const { size } = plan.parameters;
  if (size === 0) return undefined;
  const usage = GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST;
  const buffer = device.createBuffer({ label: 'moment-shadows/parameters', size: size * views, usage });
  for (let view = 0; view < views; view++) device.queue.writeBuffer(buffer, size * view, initialBlock(plan));
  return buffer;
}

class Recorder {
  constructor(device, plan, pipelines, empty, parameters) {
    Object.assign(this, { device, compiled: plan, plan, pipelines, empty, parameters, memory: [], steps: [] });
  }

  /** Takes other imports, of any size that the plan can have. Pipelines stay. Contents of the plan's textures are lost. */
  async resize(imports) {
    const { device } = this;
    const given = checkImports(this.compiled, imports);
    const plan = resized(this.compiled, sizesOf(this.compiled, imports), device.limits.maxComputeWorkgroupsPerDimension);
    checkDevice(device, plan);
    // What the graph's textures held is lost: they are others.
    const memory = [];
    const object = (index) => {
      const { home } = plan.resources[index];
      return home.import === undefined ? memory[home.memory] : given[home.import];
    };
    try {
      this.steps = await scoped(device, "the plan's objects", () => {
        memory.push(...plan.memory.map((planned) => allocate(device, planned)));
        const bound = { device, plan, object, parameters: this.parameters };
        return this.pipelines.map((made, index) => ({ ...made, ...bindPass(bound, plan.passes[index], made), pass: plan.passes[index] }));
      });
    } catch (error) {
      for (const made of memory) made.destroy();
      throw error;
    }
    this.destroy();
    Object.assign(this, { plan, memory, object });
  }

  /** Gives back the memory of the plan's textures and buffers. */
  destroy() {
    for (const made of this.memory.splice(0)) made.destroy();
  }

  /** The texture or buffer behind an output of the graph. After a resize it is another one. */
  output(name) {
    const output = this.plan.outputs.find((output) => output.name === name);
    if (output) return this.object(output.resource);
    throw new Error(`the plan has no output '${name}'; it has: ${this.plan.outputs.map((output) => output.name).join(', ')}`);
  }

  /**
   * Records a stage, 'after_shadow_maps' or 'after_main_pass'. `offset` is where the view's block begins in the parameter buffer. `layers`
   * are those to make anew: numbers, or for each map its own, `{ light_depth: [0, 2] }`; without it all. `hostPass` is called with
   * `{ name, layer, targets, depth, blend }` and the encoder where the graph leaves drawing to the host, for each layer that is made anew.
   */
  record(stage, encoder, { offset = 0, layers, hostPass } = {}) {
    // Everything is checked first: an error leaves the encoder as it was.
    checkRecording(this, stage, { offset, layers, hostPass });
    for (const step of this.steps.filter(({ pass }) => pass.stage === stage)) {
      const { pass, label, pipeline, groups, targets, drawn } = step;
      const { compute, fullscreen, host } = pass.work;
      const dirty = dirtyLayers(pass, layers);
      for (const layer of host ? dirty : []) {
        hostPass({ name: `${pass.node}/${pass.label}`, layer, ...drawn[layer], blend: host.blend }, encoder);
      }
      if (compute && dirty.length > 0) {
        const computePass = encoder.beginComputePass({ label });
        computePass.setPipeline(pipeline);
        for (const layer of dirty) {
          this.bind(computePass, step, groups[layer], offset, layer);
          computePass.dispatchWorkgroups(...compute.workgroups);
        }
        computePass.end();
      }
      for (const layer of fullscreen ? dirty : []) {
        const loadOp = fullscreen.keeps ? 'load' : 'clear';
        const colorAttachments = [{ view: targets[layer], loadOp, storeOp: 'store', clearValue: [0, 0, 0, 0] }];
        const renderPass = encoder.beginRenderPass({ label, colorAttachments });
        renderPass.setPipeline(pipeline);
        this.bind(renderPass, step, groups[layer], offset, layer);
        renderPass.draw(3);
        renderPass.end();
      }
    }
  }

  bind(encoder, { pass }, group, offset, layer) {
    for (let index = 0; index < this.plan.bind_group; index++) encoder.setBindGroup(index, this.empty);
    const offsets = pass.dynamic_offsets.map((place) => offset + place.offset + layer * place.stride);
    encoder.setBindGroup(this.plan.bind_group, group, offsets);
  }
}
