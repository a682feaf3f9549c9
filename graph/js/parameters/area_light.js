// A light of some size over its map: for soft shadows.

import { checkRange } from './depth_conversion.js';
import { isNormal, single } from './rounding.js';
import { ValueError, check } from './value_error.js';

const OF = "a light's soft shadows";
const LARGEST_RADIUS = 4096;

/** A light without size: shadows without penumbrae. */
export const NO_AREA = Object.freeze({
  size: [0, 0],
  near: 0,
  far: 1,
  perspective: 0,
  smallest_radius: 0,
  largest_radius: 0,
  rectangular: 0,
});

/** The kind of a light's size and its value; `undefined` is a light without size. */
export function sizeOf(size) {
  if (size === undefined || size === null) return ['point'];
  const kinds = Object.entries(size).filter(([kind]) => ['angularDiameter', 'disk', 'rectangle'].includes(kind));
  if (kinds.length === 1) return kinds[0];
  throw new ValueError('size', "a light's size is one of { angularDiameter }, { disk } and { rectangle: [width, height] }, or left out");
}

/**
 * The light of some size over a map: `{ angularDiameter }` in radians, of the sun 0.0093; `{ disk }`, its diameter in scene units;
 * `{ rectangle: [width, height] }`; left out, a point.
 *
 * `texel` is a texel's width and height in scene units: for rays from a point at distance 1 along the light's axis. `range` is that of
 * the map's moment depth. Search and filter keep to `radii`, the smallest and the largest half width in texels.
 */
export function areaLightOf(size, texel, range, radii) {
  const [kind, value] = sizeOf(size);
  if (kind === 'point') return NO_AREA;
  const width = widths(kind, value);
  const parallel = kind === 'angularDiameter';
  const near = 'the distance of the range\'s near end';
  check(parallel || range.near > 0, OF, near, range.near, 'above 0, in front of the light');
  checkRange(range);
  const [smallest, largest] = radii;
  check(smallest >= 0 && smallest <= largest, OF, 'the smallest radius', smallest, 'at least 0 and at most the largest');
  const legal = largest > 0 && largest <= LARGEST_RADIUS;
  check(legal, OF, 'the largest radius', largest, 'above 0 and at most 4096 texels');
  const texels = [width[0] / texel[0], width[1] / texel[1]];
  // Sizes beyond single precision come from units that do not fit together.
  const precision = 'within single precision; choose another unit of length';
  for (const [name, length] of [['a texel\'s width', texel[0]], ['a texel\'s height', texel[1]]]) {
    check(length > 0 && Number.isFinite(length), OF, name, length, 'above 0 and finite');
  }
  for (const length of texels) {
    check(isNormal(length) || length === 0, OF, "the light's size in texels", length, precision);
  }
  check(Number.isFinite(single(range.near)), OF, "the range's near end", range.near, precision);
  check(Number.isFinite(single(range.far)), OF, "the range's far end", range.far, precision);
  return {
    size: texels.map(single),
    near: single(range.near),
    far: single(range.far),
    perspective: parallel ? 0 : 1,
    smallest_radius: single(smallest),
    largest_radius: single(largest),
    rectangular: kind === 'rectangle' ? 1 : 0,
  };
}

function widths(kind, value) {
  const lengthOf = (name, length) => check(length >= 0 && Number.isFinite(length), OF, name, length, 'at least 0 and finite');
  if (kind === 'angularDiameter') {
    check(value >= 0 && value < Math.PI, OF, 'the angular diameter', value, 'at least 0 and below pi radians');
    const width = 2 * Math.tan(0.5 * value);
    return [width, width];
  }
  if (kind === 'disk') {
    lengthOf('the diameter', value);
    return [value, value];
  }
  lengthOf('the width', value[0]);
  lengthOf('the height', value[1]);
  return value;
}
