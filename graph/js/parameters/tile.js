// The square region of a map that a view of a light gets, and the filter that reads it: `{ texels, filterRadius }`.

import { ValueError, check, number } from './value_error.js';

// What places in single precision are at most off by, in texels: shaders look up that much of the guard band.
export const PLACE_ERROR = 1 / 16;
// No border has more texels.
export const WIDEST = 4095;

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

/** Checks that a region of `extent` texels has some within a guard band, and room for a border. */
export function checkBorder(guard, border, [width, height]) {
  const room = Math.min(width, height) - 2 * number('guard', guard);
  if (room > 0 || guard === 0) {
    const { width: wide } = borderOf(border);
    const range = 'from 0 texels to half of those between the guard bands, and at most 4095';
    check(wide >= 0 && wide <= Math.min(0.5 * Math.max(room, 0), WIDEST), 'a view', 'border', wide, range);
    return;
  }
  const message =
    `a region of ${width}x${height} texels has no room between guard bands of ${guard} texels; give it more texels, or a filter that ` +
    'reaches less far';
  throw new ValueError('guard', message);
}

/** The width of a border in texels, and what shaders are told beside the channel. */
export function borderOf(border) {
  if (border === undefined || border === 'sharp') return { width: 0, flags: 0 };
  const entries = Object.entries(border ?? {});
  const [kind, width] = entries[0] ?? [];
  if (entries.length === 1 && ['blend', 'fade', 'cone'].includes(kind)) {
    return { width, flags: { blend: 0, fade: 16, cone: 48 }[kind] };
  }
  throw new ValueError('border', "a view's border is 'sharp', { blend }, { fade } or { cone }, each with a width in texels");
}

/** A tile's region before it has a place. */
export const regionOf = ({ texels }) => ({ origin: [0, 0], extent: [texels, texels] });
