// The cascades of a sun: views of one light, each for a part of what a camera sees, a slice of its frustum. Texels keep their size and stay
// where they are in the scene while the camera moves and turns.

import { sphereOf } from './frustum.js';
import { lightAxes } from './light_axes.js';
import { transposed } from './matrix.js';
import { whole } from './rounding.js';
import { WIDEST, guardOf, regionOf } from './tile.js';
import { ValueError, check } from './value_error.js';
import { dot, isFinite, scaled } from './vector.js';

// By how much spheres grow, so that rounding in a host's matrices of single precision does not change the size of texels.
const GROWTH = 1 + 1 / 65536;
// Steps of a cascade's range in which it moves along the light: a power of two, as with the grid of ranges that fit themselves.
const STEPS = 16;
// Places farther from the scene's origin have less than 12 bits within a texel.
const FARTHEST = 2 ** 40;
const MOST = 256;

/** Where each slice begins and ends, its overlap with the next one included. */
export function cascadeSlices({ splits, near, far, overlap = 0 }) {
  const checked = (valid, name, value, legal) => check(valid, 'cascades', name, value, legal);
  checked(near >= 0 && near < far, 'near', near, 'at least 0 and below far');
  checked(Number.isFinite(far), 'far', far, 'finite');
  checked(overlap >= 0 && overlap <= 1, 'overlap', overlap, '0 to 1');
  const ends = endsOf(splits, near, far, checked);
  return ends.slice(1).map((end, index) => [ends[index], Math.min(end + overlap * (end - ends[index]), far)]);
}

// The distances from the nearest to the farthest, one more than there are cascades.
function endsOf(splits, near, far, checked) {
  const { blend, given } = splits ?? {};
  let inner = given;
  if (blend) {
    const { count, logarithmic } = blend;
    checked(Number.isInteger(count) && count >= 1 && count <= MOST, 'count', count, '1 to 256');
    checked(logarithmic >= 0 && logarithmic <= 1, 'logarithmic', logarithmic, '0 to 1');
    checked(logarithmic === 0 || near > 0, 'near', near, 'above 0, unless cascades are divided uniformly');
    inner = Array.from({ length: count - 1 }, (_, index) => {
      const part = (index + 1) / count;
      const uniform = near + (far - near) * part;
      return logarithmic === 0 ? uniform : uniform + logarithmic * (near * Math.pow(far / near, part) - uniform);
    });
  }
  const ends = [near, ...(inner ?? []), far];
  const ascend = ends.every((end, index) => index === 0 || ends[index - 1] < end);
  if (inner && ends.length <= MOST + 1 && ascend) return ends;
  const message =
    `cascades cannot end at ${ends}: give { blend: { count, logarithmic } }, or { given } with at most ${MOST - 1} distances, ` +
    'ascending, between the nearest and the farthest one';
  throw new ValueError('splits', message);
}

/**
 * The views, from near to far: of the views that contain a pixel the first shades it. They have no places yet; `placeViews` gives them.
 */
export function cascadeViews(cascades, camera) {
  const slices = cascadeSlices(cascades);
  const { texels } = cascades.tile;
  const guard = guardOf(cascades.tile);
  check(texels - 2 * guard > 1, 'cascades', 'texels', texels, '2 texels more than the guard bands');
  const { blend = 0 } = cascades;
  const width = blend * (texels - 2 * guard);
  check(blend >= 0 && blend <= 0.5 && width <= WIDEST, 'cascades', 'blend', blend, `0 to 0.5, and at most ${WIDEST} texels of a view`);
  const axes = lightAxes(cascades.direction);
  const casters = castersOf(cascades, axes);
  const sphere = sphereOf(camera);
  const border = (index) => (index + 1 < slices.length ? { blend: width } : { fade: width });
  return slices.map((slice, index) => ({
    ...view(cascades, axes, sphere(slice), casters, guard),
    border: blend > 0 ? border(index) : 'sharp',
  }));
}

// The lowest and the highest coordinates of the casters in the light's axes.
function castersOf({ casters, pancaking = false }, axes) {
  if (casters === undefined || casters === null) {
    if (pancaking) return undefined;
    const message = 'without pancaking near planes lie in front of all casters; give a box around them';
    throw new ValueError('casters', message);
  }
  const [low, high] = casters;
  if (!(isFinite(low) && isFinite(high) && low.every((value, index) => value <= high[index]))) {
    const message = `the box around the casters goes from ${low} to ${high}; give its lowest and its highest corner, finite`;
    throw new ValueError('casters', message);
  }
  const [middle, half] = [1, -1].map((sign) => low.map((value, index) => 0.5 * (high[index] + sign * value)));
  return [-1, 1].map((sign) => axes.map((axis) => dot(axis, middle) + sign * dot(axis.map(Math.abs), half)));
}

// The view around a sphere.
function view({ tile, pancaking = false, reversed = false }, axes, { centre, radius }, casters, guard) {
  const inner = tile.texels - 2 * guard;
  // One texel is lost to snapping.
  const texelFor = (side) => roundedUp((GROWTH * side) / (inner - 1));
  let texel = texelFor(2 * radius);
  const [first, second, third] = axes.map((axis) => dot(axis, centre));
  let middle = [first, second];
  // One step is lost to snapping.
  const step = roundedUp((inner * texel) / (STEPS - 1));
  const depth = whole(third / step);
  let [near, far] = [-0.5, 0.5].map((half) => (depth + half * STEPS) * step);
  if (casters) {
    const [low, high] = casters;
    // A texel more, for rounding.
    const [begins, ends] = [Math.max(near, low[2] - texel), Math.min(far, high[2] + texel)];
    if (begins < ends) [near, far] = [begins, ends];
    if (!pancaking) near = Math.min(near, low[2] - texel);
    const side = Math.max(high[0] - low[0], high[1] - low[1]);
    const fitted = Math.max(texelFor(side), texel / 1024);
    if (fitted < texel) [texel, middle] = [fitted, [0, 1].map((axis) => 0.5 * (low[axis] + high[axis]))];
  }
  const origin = middle.map((value) => whole(value / texel) * texel);
  const across = 2 / (tile.texels * texel);
  // The light's first axis is up, so that the matrix mirrors nothing.
  const [up, right, along] = axes;
  const extent = far - near;
  const z = reversed ? [...scaled(along, -1 / extent), far / extent] : [...scaled(along, 1 / extent), -near / extent];
  const rows = [scaled([...right, -origin[1]], across), scaled([...up, -origin[0]], across), z, [0, 0, 0, 1]];
  const resolved = origin.every((value) => Math.abs(value / texel) <= FARTHEST);
  if (!(texel >= 2 ** -1022 && resolved && isFinite(rows.flat()))) {
    const message =
      'the frustum is too large, too small or too far away for double precision; choose another unit of length, or make positions ' +
      'relative to a place nearby';
    throw new ValueError('camera', message);
  }
  return { clipFromWorld: transposed(rows), depth: { orthographic: { reversed } }, layer: 0, region: regionOf(tile), guard, channel: 0 };
}

// The next number with 11 significant bits: whole multiples of it are exact, and rounding errors before do not change it.
function roundedUp(length) {
  const rest = (1n << 42n) - 1n;
  const [bits] = new BigUint64Array(Float64Array.of(length).buffer);
  return new Float64Array(BigUint64Array.of(BigInt.asUintN(64, bits + rest) & ~rest).buffer)[0];
}
