// Filter kernels of blurs whose weights are a parameter: those with `per_frame`, those of a radius above 12, and those with a `width`.
//
// Weights are not negative, multiples of 2^-18, and sum to exactly 1: only filters with such weights keep moments valid.

import { single } from './rounding.js';
import { ValueError } from './value_error.js';

const WEIGHT_UNIT = 2 ** -18;
const LARGEST_RADIUS = 64;

// Of a texel's square and of a bilinear lookup.
const VARIANCE_OF_TEXELS = 1 / 12 + 1 / 6;

// As the node's shader has it: outputs of an invocation, and vectors of weights.
const OUTPUTS = 16;
const VECTORS = 40;

/** A Gaussian of standard deviation `sigma` texels, cut off at `radius` texels: its weights. */
export function gaussianKernel(radius, sigma) {
  if (!(Number.isInteger(radius) && radius >= 1 && radius <= LARGEST_RADIUS)) {
    throw new ValueError('radius', `a kernel's radius is 1 to ${LARGEST_RADIUS} texels, not ${radius}`);
  }
  const width = single(sigma);
  if (!(Number.isFinite(width) && width > 0)) {
    throw new ValueError('sigma', `a Gaussian's sigma is a positive number of texels, not ${sigma}`);
  }
  const weights = Array.from({ length: 2 * radius + 1 }, (_, index) => {
    const ratio = (index - radius) / width;
    return Math.exp(-0.5 * ratio * ratio);
  });
  return normalised(weights);
}

/**
 * The kernel by which shadows in a map are filtered over a width in scene units, whatever the size of its texels: `width` is the
 * standard deviation of the whole filter in texels, of which the lookup is a part. Its radius is at most `largest`.
 */
export function kernelOfWidth(width, largest = LARGEST_RADIUS) {
  const deviation = deviationOfWidth(width);
  const variance = deviation * deviation;
  const radius = Math.max(Math.ceil(2 * deviation), 1);
  const most = Math.min(largest, LARGEST_RADIUS);
  if (!(width >= 0 && radius <= most)) {
    const widest = Math.sqrt((most * most) / 4 + VARIANCE_OF_TEXELS);
    const message = `a filter of a standard deviation of ${width} texels; a kernel of radius ${most} has at most ${widest}`;
    throw new ValueError('width', message);
  }
  let [low, high] = [0, 1];
  for (let round = 0; round < 32; round++) {
    const middle = 0.5 * (low + high);
    if (varianceOf(powers(middle, radius)) < variance) {
      low = middle;
    } else {
      high = middle;
    }
  }
  const half = powers(low, radius);
  return normalised([...half.slice(1).reverse(), ...half]);
}

/** The standard deviation of that kernel in texels, for `receiverBias`. */
export function deviationOfWidth(width) {
  return Math.sqrt(Math.max(width * width - VARIANCE_OF_TEXELS, 0));
}

// Half of the weights: q to the power of k k.
function powers(q, radius) {
  const weights = [1];
  let step = q;
  for (let offset = 0; offset < radius; offset++) {
    weights.push(weights[offset] * step);
    step *= q * q;
  }
  return weights;
}

function varianceOf(half) {
  let [sum, squares] = [1, 0];
  for (let offset = 1; offset < half.length; offset++) {
    sum += 2 * half[offset];
    squares += 2 * half[offset] * (offset * offset);
  }
  return squares / sum;
}

/** Given weights, normalised. Their number is odd, 3 to 129; the middle one belongs to the texel itself. */
export function kernelFromWeights(given) {
  const weights = Array.from(given, single);
  const [count, most] = [weights.length, 2 * LARGEST_RADIUS + 1];
  if (count % 2 === 0 || count < 3 || count > most) {
    throw new ValueError('weights', `a kernel has an odd number of weights, 3 to ${most}, not ${count}`);
  }
  const wrong = weights.findIndex((weight) => !(Number.isFinite(weight) && weight >= 0));
  if (wrong >= 0) {
    const message = `weight ${wrong} is ${given[wrong]}; a filter of moments needs finite weights that are not negative`;
    throw new ValueError('weights', message);
  }
  if (weights.every((weight) => weight === 0)) {
    throw new ValueError('weights', 'all weights are 0; at least one must be positive');
  }
  return normalised(weights);
}

/** The kernel's standard deviation in texels, for `receiverBias`: smaller than the sigma of a Gaussian, which the radius cuts off. */
export function standardDeviation(weights) {
  const meanOf = (value) => weights.reduce((sum, weight, index) => sum + value(index) * weight, 0);
  const mean = meanOf((position) => position);
  const variance = meanOf((position) => (position - mean) * (position - mean));
  return single(Math.sqrt(Math.max(variance, 0)));
}

/** The struct `BlurParameters` of a kernel: weights are preceded by 15 zeros and followed by zeros. */
export function blurParameters(weights) {
  const radius = (weights.length - 1) / 2;
  const padded = Array.from({ length: VECTORS * 4 }, (_, index) => weights[index - (OUTPUTS - 1)] ?? 0);
  return {
    radius,
    blocks: Math.ceil((2 * radius + OUTPUTS) / 16),
    width: 0,
    weights: Array.from({ length: VECTORS }, (_, index) => padded.slice(4 * index, 4 * index + 4)),
  };
}

// Partial sums are rounded, so that no weight gets all of the residue.
function normalised(weights) {
  const total = weights.reduce((sum, weight) => sum + weight, 0);
  let [sum, before] = [0, 0];
  return weights.map((weight) => {
    sum += weight;
    const units = Math.round(sum / total / WEIGHT_UNIT);
    const rounded = (units - before) * WEIGHT_UNIT;
    before = units;
    return rounded;
  });
}
