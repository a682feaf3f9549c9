// How far fragments move towards the light before they are shaded.

import { single, whole } from './rounding.js';
import { number } from './value_error.js';

// These have the names that they have in `src/receiver_bias.rs`, which gives the reasons.
const STANDARD_DEVIATIONS = 1.25;
const VARIANCE_OF_SAMPLING = single(single(1 / 12) + 0.25);
const STEEPEST_TANGENT = single(11.43);
const DEPTH_ERROR = single(3e-5);

/** No bias at all: for maps whose casters are not receivers. */
export const NO_BIAS = Object.freeze({ constant: 0, slope_scale: 0, maximum: 0, step: 0 });

/**
 * The bias that follows from a kernel, for all scenes.
 *
 * `standardDeviation` is the kernel's along one axis in texels: `deviation` of the map's description in the plan, 0 where there is
 * none. `depthPerTexel` is that of the light's view (`depthPerTexel` of this package).
 */
export function receiverBias(standardDeviation, depthPerTexel) {
  // In single precision throughout, as the library's other hosts have it.
  const deviation = single(number('the standard deviation', standardDeviation));
  const variance = single(single(deviation * deviation) + VARIANCE_OF_SAMPLING);
  const slope = single(STANDARD_DEVIATIONS * single(Math.sqrt(variance)));
  const steepest = single(single(slope * STEEPEST_TANGENT) * single(number('the depth per texel', depthPerTexel)));
  return { constant: DEPTH_ERROR, slope_scale: slope, maximum: single(DEPTH_ERROR + steepest), step: 0 };
}

// The largest step between neighbouring depths in [0, 1].
const FLOATING = 2 ** -24;
const STEPS = {
  depth16unorm: 1 / 65535,
  depth24plus: 1 / 16777215,
  'depth24plus-stencil8': 1 / 16777215,
  depth32float: FLOATING,
  'depth32float-stencil8': FLOATING,
  r32float: FLOATING,
};

/** A bias for a light whose depth map has this format: 16 bits of hyperbolic depth are coarse far from the near plane. */
export function biasForStoredDepth(bias, format, conversion) {
  const [[n0, n1], [m0, m1]] = [conversion.numerator, conversion.denominator];
  if (!(format in STEPS)) return bias;
  const isFloating = STEPS[format] === FLOATING;
  // Reversed floats are coarse nowhere: their steps shrink with the depth that they store.
  if (isFloating && n1 * m0 < n0 * m1) return bias;
  const { scale, offset } = conversion;
  // Of floats its share of the largest number that is stored, near plane or far.
  const factorOfStep = isFloating ? Math.max(Math.abs(offset), Math.abs(1 - offset)) : Math.abs(scale);
  const step = STEPS[format] * factorOfStep;
  // z(d) = n / m with n and m linear in d, so |dz/dd| = (n' - z m')^2 / |m' n0 - n' m0|.
  const determinant = Math.abs((m1 - m0) * n0 - (n1 - n0) * m0);
  const factor = Math.sqrt(step / Math.max(determinant, 2 ** -1022));
  // As WGSL's unpack2x16snorm has it, of half the numbers: both ends of the range are at most 2 moment depths coarse.
  const packed = (root) => Math.min(Math.max(whole(root * factor * 0.5 * 32767) || 0, -32768), 32767) & 0xffff;
  return { ...bias, step: (packed(n1 - n0) | (packed(m0 - m1) << 16)) >>> 0 };
}
