// The air between camera and surfaces: how much of the sun's light it scatters towards the camera, shadows in it included.

import { depthConversion, medium, scatteringParameters, write } from 'moment-shadows-graph/parameters.js';
import { Recorded } from './recorded.js';

// Up to here the air is lit, in scene units along the camera's axis.
export const FAR = 60;

/** Air that takes `density` of the light per scene unit, a little more of blue, and scatters most of it, forwards by `anisotropy`. */
export function air({ density, anisotropy }) {
  const extinction = [0.92, 1, 1.08].map((factor) => factor * density);
  const scattering = extinction.map((value) => 0.95 * value);
  return { extinction, scattering, anisotropy, irradiance: [4.7, 4.5, 4] };
}

export class Air extends Recorded {
  look(camera, clipFromWorld, settings) {
    const { plan } = this.recorder;
    const sun = { clipFromWorld, depth: { orthographic: { reversed: false } } };
    const { rectify, integrate, composite } = scatteringParameters(camera, FAR, sun, medium(air(settings)));
    write(plan, this.block, 'resolve', 0, depthConversion(sun.depth));
    write(plan, this.block, 'rectify', 0, rectify);
    write(plan, this.block, 'integrate', 0, integrate);
    write(plan, this.block, 'composite', 0, composite);
    this.send();
  }

  /** Radiance, and in alpha what is left of the surface behind. */
  get scattering() {
    return this.recorder.output('scattering');
  }
}
