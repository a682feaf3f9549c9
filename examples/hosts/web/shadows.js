// A plan of shadows, recorded: from where camera and sun are to a texture of shadow intensity.

import { createRecorder } from 'moment-shadows-graph';
import {
  areaLight,
  biasForStoredDepth,
  depthConversion,
  depthPerTexel,
  initialBlock,
  receiverBias,
  viewParameters,
  write,
} from 'moment-shadows-graph/parameters.js';

// What depth is off by where a rasteriser moves corners to the nearest sixteenth of a pixel, as SwiftShader does, in moment depth: two
// hundredths of a scene unit. Filtered maps hide it, comparisons with the plain depth map do not.
const RASTERISER = 0.002;

// The sun of the soft shadows, larger than the real one, so that it is seen.
const SUN = { angularDiameter: 0.05 };

export class Shadows {
  /** `map` is the resource that the plan's node `shade` looks up. */
  static async create(device, plan, map, imports) {
    const shadows = new Shadows();
    const recorder = await createRecorder(device, plan, imports);
    return Object.assign(shadows, { device, recorder, map, block: initialBlock(plan) });
  }

  resize(imports) {
    return this.recorder.resize(imports);
  }

  destroy() {
    this.recorder.destroy();
    this.recorder.parameters.destroy();
  }

  /** Tells the plan's nodes where camera and sun are. */
  look(camera, clipFromWorld) {
    const { plan, parameters } = this.recorder;
    const isSoft = this.map.endsWith('.table');
    const sun = { clipFromWorld, depth: { orthographic: { reversed: false } }, size: isSoft ? SUN : undefined };
    const { deviation = 0, size, encoding } = plan.resources.find(({ name }) => name === this.map).desc.texture;
    const conversion = depthConversion(sun.depth);
    const bias = biasForStoredDepth(receiverBias(deviation, depthPerTexel(sun, size)), 'depth32float', conversion);
    if (!encoding) bias.constant += RASTERISER;
    const largest = isSoft ? Math.min(...encoding.table.largest_kernel) / 2 : 1;
    const view = viewParameters(camera, sun, bias, undefined, areaLight(sun, size, [1, largest]));
    // What reads the plain depth map needs no node that makes another one of it.
    const nodes = plan.parameters.blocks.map(({ node }) => node);
    if (nodes.includes('resolve')) write(plan, this.block, 'resolve', 0, conversion);
    write(plan, this.block, 'shade', 0, view);
    this.device.queue.writeBuffer(parameters, 0, this.block);
  }

  record(stage, encoder) {
    this.recorder.record(stage, encoder);
  }

  get intensity() {
    return this.recorder.output('shadow_intensity');
  }
}
