// How a host's stored depth becomes moment depth: the struct `DepthConversion`, of node `resolve` and of views.

import { single } from './rounding.js';
import { ValueError } from './value_error.js';

/**
 * The conversion for how a light's map stores depth.
 *
 * `{ orthographic: { reversed } }`: linear, 0 at the near plane, or 1 where it is reversed.
 * `{ perspective: { near, far, reversed, range } }`: hyperbolic; `far` may be Infinity.
 * `{ linear: { range } }`: the distance along the light's axis in scene units.
 * `range` has the distances `near` and `far` that map to the moment depths -1 and 1.
 */
export function depthConversion(depth) {
  const [kind, settings] = kindOf(depth);
  const forward = { orthographic, perspective, linear }[kind](settings);
  if (kind === 'linear' || !settings.reversed) return forward;
  const turned = ([a, b]) => [b, a];
  return { ...forward, numerator: turned(forward.numerator), denominator: turned(forward.denominator) };
}

/** The kind of a light's depth and its settings. */
export function kindOf(depth) {
  const kinds = Object.entries(depth ?? {}).filter(([kind]) => ['orthographic', 'perspective', 'linear'].includes(kind));
  if (kinds.length === 1) return [kinds[0][0], kinds[0][1] ?? {}];
  throw new ValueError('depth', "a light's depth is one of { orthographic }, { perspective } and { linear }, each with its settings");
}

/** Checks that a range is finite and not empty. */
export function checkRange({ near, far } = {}) {
  if (Number.isFinite(near) && Number.isFinite(far) && near < far) return;
  const message = `the depth range ${near} to ${far} is empty or not finite; give finite distances with near < far`;
  throw new ValueError('the depth range', message);
}

const orthographic = () => ofEnds([-1, 1], [1, 1]);

function perspective({ near, far, range }) {
  checkRange(range);
  if (!(Number.isFinite(near) && near > 0 && far > near)) {
    const message =
      `a perspective light cannot have its near plane at ${near} and its far plane at ${far}; ` +
      'the near plane lies in front of the light and before the far plane';
    throw new ValueError('the planes', message);
  }
  // Distance t = near / ((1 - d) + d near / far); moment depth = (2 t - (a + b)) / (b - a).
  const ratio = near / far;
  const [added, extent] = [range.near + range.far, range.far - range.near];
  // Dividing by the near plane keeps the four numbers in the range of single precision for any unit of length.
  const ends = (weight) => [(2 * near - added * weight) / near, (extent * weight) / near];
  const [first, last] = [ends(1), ends(ratio)];
  return ofEnds([first[0], last[0]], [first[1], last[1]]);
}

function linear({ range }) {
  checkRange(range);
  const extent = range.far - range.near;
  return { ...orthographic(), scale: single(1 / extent), offset: single(-range.near / extent) };
}

function ofEnds(numerator, denominator) {
  // Only ratios matter: the largest becomes 1.
  const largest = [...numerator, ...denominator].reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);
  const rounded = (pair) => pair.map((value) => single(value / largest));
  return { numerator: rounded(numerator), denominator: rounded(denominator), scale: 1, offset: 0 };
}
