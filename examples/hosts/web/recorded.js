// A plan in the renderer: recorded, resized, given back. What its nodes are told each frame is said by who extends it.

import { createRecorder } from 'moment-shadows-graph';
import { initialBlock } from 'moment-shadows-graph/parameters.js';

export class Recorded {
  static async create(device, plan, imports, more) {
    const made = new this();
    const recorder = await createRecorder(device, plan, imports);
    return Object.assign(made, { device, recorder, block: initialBlock(plan) }, more);
  }

  /** The texture of a resource, as the plan has it for the imports at hand. */
  texture(name) {
    return this.recorder.plan.resources.find((resource) => resource.name === name).desc.texture;
  }

  /** Whether there is a node of this name, with parameters. */
  has(name) {
    return this.recorder.plan.parameters.blocks.some(({ node }) => node === name);
  }

  /** Sends what has been written into the block. */
  send() {
    this.device.queue.writeBuffer(this.recorder.parameters, 0, this.block);
  }

  record(stage, encoder) {
    this.recorder.record(stage, encoder);
  }

  resize(imports) {
    return this.recorder.resize(imports);
  }

  destroy() {
    this.recorder.destroy();
    this.recorder.parameters.destroy();
  }
}
