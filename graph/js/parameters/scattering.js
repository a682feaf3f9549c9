// Single scattering: a medium, and the structs of the nodes `rectify_moments`, `integrate_scattering` and `composite_scattering`.

import { kindOf } from './depth_conversion.js';
import { completed, momentDepthRow } from './light_view.js';
import { row, singular } from './matrix.js';
import { rectifiedView } from './rectified_view.js';
import { single } from './rounding.js';
import { ValueError, check } from './value_error.js';
import { cross, dot, isFinite, scaled } from './vector.js';

const OF = 'single scattering';

// Products of three numbers up to this and a distance stay finite.
const LARGEST = 1e9;

/**
 * A homogeneous medium: extinction and scattering per scene unit by colour, the anisotropy of its phase function from -0.99
 * (backwards) to 0.99 (forwards), and the irradiance of a surface that faces the light.
 */
export function medium({ extinction, scattering, anisotropy = 0, irradiance }) {
  for (const [name, values] of Object.entries({ extinction, scattering, irradiance })) {
    for (const value of values.map(single)) {
      check(value >= 0 && value <= LARGEST, OF, `the ${name}`, value, 'at least 0 and at most 1e9');
    }
  }
  const valid = single(anisotropy) >= single(-0.99) && single(anisotropy) <= single(0.99);
  check(valid, OF, 'the anisotropy', anisotropy, 'from -0.99 to 0.99');
  const [red, green, blue] = extinction.map(single);
  return {
    extinction: [red, green, blue],
    anisotropy: single(anisotropy),
    scattering: scattering.map(single),
    mean_extinction: single(single(single(red + green) + blue) / 3),
    irradiance: irradiance.map(single),
  };
}

/**
 * The parameters of the three nodes for a perspective camera with surfaces and sky up to the distance `far` along its axis, a
 * directional light and a medium.
 */
export function scatteringParameters(camera, far, light, air) {
  const { clip: given, depth: stored, region, layer } = completed(light);
  const last = row(given, 3);
  if (kindOf(stored)[0] !== 'orthographic' || last.slice(0, 3).some((entry) => entry !== 0)) {
    const message =
      'the light is a point or spot light; only rays of a directional light are parallel to one axis of rectified coordinates: give an ' +
      'orthographic light, or march the scattering of this one';
    throw new ValueError('light', message);
  }
  const clip = given.map((column) => scaled(column, 1 / last[3]));
  const [x, y, depth] = [row(clip, 0), row(clip, 1), momentDepthRow(stored, clip)];
  // Along the light the place in its map stays.
  const across = cross(x.slice(0, 3), y.slice(0, 3));
  const grows = dot(depth.slice(0, 3), across);
  if (!(Math.abs(grows) > 0 && Number.isFinite(grows) && isFinite([...x, ...y, ...depth]))) throw singular('light');
  const { camera: eye, axes, frame } = rectifiedView(camera.clipFromWorld, far, scaled(across, Math.sign(grows)));
  const at = [...eye, 1];
  const directions = axes.map((axis) => [...axis, 0]);
  // u = (x + 1) / 2, v = (1 - y) / 2.
  const map = (u, v) => [single(0.5 * u), single(-0.5 * v)];
  const along = (axis) => map(dot(x, axis), dot(y, axis));
  return {
    rectify: {
      frame,
      map_at_camera: map(dot(x, at) + 1, dot(y, at) - 1),
      map_along_first: along(directions[0]),
      map_along_second: along(directions[1]),
      depth_at_camera: single(dot(depth, at)),
      depth_per_length: single(dot(depth, directions[2])),
      region,
      layer,
    },
    integrate: { frame, extinction: air.mean_extinction },
    composite: { frame, medium: air },
  };
}
