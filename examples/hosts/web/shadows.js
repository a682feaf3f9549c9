// A plan of shadows, recorded: from where camera and sun are to a texture of shadow intensity.

import {
  areaLight,
  biasForStoredDepth,
  depthConversion,
  depthPerTexel,
  receiverBias,
  viewParameters,
  write,
} from 'moment-shadows-graph/parameters.js';
import { Recorded } from './recorded.js';

// What depth is off by where a rasteriser moves corners to the nearest sixteenth of a pixel, as SwiftShader does, in moment depth: two
// hundredths of a scene unit. Filtered maps hide it, comparisons with the plain depth map do not.
const RASTERISER = 0.002;

export class Shadows extends Recorded {
  /** Tells the plan's nodes where camera and sun are, and where shadows are soft how large the sun is, in radians. */
  look(camera, clipFromWorld, size) {
    const { plan } = this.recorder;
    // The resource that the node `shade` looks up.
    const map = this.texture(this.map);
    const isSoft = this.map.endsWith('.table');
    const sun = {
      clipFromWorld,
      depth: { orthographic: { reversed: false } },
      size: isSoft ? { angularDiameter: size } : undefined,
    };
    const conversion = depthConversion(sun.depth);
    const { deviation = 0 } = map;
    const bias = biasForStoredDepth(receiverBias(deviation, depthPerTexel(sun, map.size)), 'depth32float', conversion);
    if (!map.encoding) bias.constant += RASTERISER;
    const largest = isSoft ? Math.min(...map.encoding.table.largest_kernel) / 2 : 1;
    // What reads the plain depth map needs no node that makes another one of it.
    if (this.has('resolve')) write(plan, this.block, 'resolve', 0, conversion);
    write(plan, this.block, 'shade', 0, viewParameters(camera, sun, bias, undefined, areaLight(sun, map.size, [1, largest])));
    this.send();
  }

  get intensity() {
    return this.recorder.output('shadow_intensity');
  }
}
