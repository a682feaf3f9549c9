// The square region of a map that a view of a light gets, and the filter that reads it: `{ texels, filterRadius }`.

import { ValueError, check, number } from './value_error.js';

// What places in single precision are at most off by, in texels: shaders look up that much of the guard band.
export const PLACE_ERROR = 1 / 16;

/**
 * The width of a tile's guard band in whole texels: how many texels its filters reach to each side, one after the other, and half a
 * texel for a bilinear lookup. It is drawn and filtered, and no place is looked up in it.
 */
export function guardOf({ texels, filterRadius }) {
  check(Number.isInteger(texels) && texels > 0, 'a region', 'texels', texels, 'a whole number above 0');
  const valid = Number.isFinite(filterRadius) && filterRadius >= 0;
  check(valid, 'a region', 'filter_radius', filterRadius, 'at least 0 and finite');
  const guard = Math.ceil(filterRadius + 0.5 + PLACE_ERROR);
  if (2 * guard < texels) return guard;
  const message =
    `a region of ${texels} texels has no room between guard bands of ${guard} texels, which a filter of radius ${filterRadius} needs; ` +
    `give it more than ${2 * guard} texels`;
  throw new ValueError('guard', message);
}

/** Checks that a region of `extent` texels has some within a guard band. */
export function checkGuard(guard, [width, height]) {
  if (guard === 0 || 2 * number('guard', guard) < Math.min(width, height)) return;
  const message =
    `a region of ${width}x${height} texels has no room between guard bands of ${guard} texels; give it more texels, or a filter that ` +
    'reaches less far';
  throw new ValueError('guard', message);
}

/** A tile's region before it has a place. */
export const regionOf = ({ texels }) => ({ origin: [0, 0], extent: [texels, texels] });
