// Views of lights: what one region of a light's map was drawn with.
//
// A view is `{ clipFromWorld, depth, layer, region, guard, border, channel, size }`. Only the matrix has to be given: without the rest it is that of a
// sun without size which has the first layer of its map to itself and stores 0 at the near plane.

import { areaLightOf, sizeOf } from './area_light.js';
import { kindOf } from './depth_conversion.js';
import { WHOLE } from './map_region.js';
import { columns, row } from './matrix.js';
import { ValueError } from './value_error.js';
import { length, scaled, sum } from './vector.js';

const SUN = { depth: { orthographic: { reversed: false } }, layer: 0, region: WHOLE, guard: 0, border: 'sharp', channel: 0 };

/** The view with everything said: its matrix by columns, and what was left out. */
export function completed(light) {
  const given = Object.fromEntries(Object.entries(light).filter(([, value]) => value !== undefined));
  return { ...SUN, ...given, clip: columns(light.clipFromWorld, 'light') };
}

const isParallel = (depth) => kindOf(depth)[0] === 'orthographic';

/** The linear function of a scene position (x, y, z, 1) that gives its moment depth. */
export function momentDepthRow(depth, clip) {
  const [kind, settings] = kindOf(depth);
  let [axis, factor, summand] = [row(clip, 2), settings.reversed ? -2 : 2, settings.reversed ? 1 : -1];
  if (kind !== 'orthographic') {
    const { near, far } = settings.range;
    const extent = far - near;
    [axis, factor, summand] = [row(clip, 3), 2 / extent, -(near + far) / extent];
  }
  return sum(scaled(axis, factor), scaled([0, 0, 0, 1], summand));
}

/** Checks that depth is stored as maps with such a matrix store it. */
export function checkMatrix(depth, clip) {
  const parallel = row(clip, 3).slice(0, 3).every((entry) => entry === 0);
  if (parallel === isParallel(depth)) return;
  const message =
    "the light's matrix and its depth do not agree: a matrix with parallel rays goes with orthographic depth, one with perspective " +
    'with the other kinds';
  throw new ValueError('depth', message);
}

/**
 * Width and height of a texel in scene units, where the region has `extent` texels: with a perspective map, at distance 1 along the
 * light's axis.
 */
export function texelSize(light, extent) {
  const { clip, depth } = completed(light);
  const lengthOf = (index) => length(row(clip, index).slice(0, 3));
  const divisor = isParallel(depth) ? Math.abs(clip[3][3]) : lengthOf(3);
  return [0, 1].map((axis) => (2 * divisor) / (lengthOf(axis) * extent[axis]));
}

/** Distances along the light's axis of the moment depths -1 and 1; for parallel rays from the near plane on. */
export function depthRange(light) {
  const { clip, depth } = completed(light);
  const [kind, settings] = kindOf(depth);
  if (kind !== 'orthographic') return settings.range;
  const perUnit = length(momentDepthRow(depth, clip).slice(0, 3)) / Math.abs(clip[3][3]);
  return { near: 0, far: 2 / perUnit };
}

/** The moment depth of a texel's width along the light's axis, as `receiverBias` takes it; `extent` are the region's texels. */
export function depthPerTexel(light, extent) {
  const [width, height] = texelSize(light, extent);
  const { near, far } = depthRange(light);
  const spread = isParallel(completed(light).depth) ? 1 : far;
  return (2 * Math.max(width, height) * spread) / (far - near);
}

/** Checks that the kind of size suits the kind of rays. */
export function checkSize(depth, size) {
  const [kind] = sizeOf(size);
  if (kind !== 'point' && isParallel(depth) !== (kind === 'angularDiameter')) {
    const message =
      'a light with parallel rays has an angular diameter as its size, one with a perspective map is a disk or a rectangle';
    throw new ValueError('size', message);
  }
}

/** The light with its size over a map whose region has `extent` texels; `radii`: see `areaLightOf`. */
export function areaLight(light, extent, radii) {
  const { depth, size } = completed(light);
  checkSize(depth, size);
  return areaLightOf(size, texelSize(light, extent), depthRange(light), radii);
}
