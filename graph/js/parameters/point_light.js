// Views of a light that shines from a point: `{ position, depth, tile, nearestCaster }`. `depth` is perspective, or linear; the planes of projections are
// then those of the range, which has to begin in front of the light.

import { depthConversion, kindOf } from './depth_conversion.js';
import { lightAxes } from './light_axes.js';
import { transposed } from './matrix.js';
import { guardOf, regionOf } from './tile.js';
import { ValueError, check } from './value_error.js';
import { cross, dot, isFinite, scaled, sum } from './vector.js';

/**
 * The view of a spot that shines along `direction` (of any length); `angle` is the full angle of its cone in radians. Within the guard
 * band the region shows the square around the cone.
 */
export function spotView(light, direction, angle) {
  const axes = lightAxes(direction);
  check(angle > 0 && angle < Math.PI, 'a spot', 'angle', angle, 'above 0 and below pi radians');
  const [up, right, forward] = axes;
  return view(light, [right, up, forward], Math.tan(0.5 * angle));
}

/** The views of the six faces, +x, -x, +y, -y, +z and -z, which meet at their edges within their guard bands. */
export function pointLightFaces(light) {
  return [0, 1, 2].flatMap((axis) =>
    [1, -1].map((sign) => {
      const unit = (index) => [0, 1, 2].map((at) => (at === index ? 1 : 0));
      const forward = scaled(unit(axis), sign);
      const up = unit(axis === 1 ? 2 : 1);
      return view(light, [cross(forward, up), up, forward], 1);
    }),
  );
}

// A view along the last of the axes; `tangent` is that of half the angle within the guard band.
function view({ position, depth, tile, nearestCaster }, [right, up, forward], tangent) {
  const guard = guardOf(tile);
  check(isFinite(position), 'a point light', 'position', position, 'finite');
  const [kind, settings] = kindOf(depth);
  if (kind === 'orthographic') {
    throw new ValueError('depth', 'rays from a point are not parallel: depth is perspective or linear');
  }
  const { near, far, reversed } = kind === 'linear' ? settings.range ?? {} : settings;
  depthConversion({ perspective: { near, far, range: settings.range } });
  const across = (tile.texels - 2 * guard) / (tile.texels * tangent);
  checkNearestCaster(nearestCaster, Math.max(near, settings.range.near), across);
  const row = (axis) => [...axis, -dot(axis, position)];
  const w = row(forward);
  // (distance - near) / (1 - near / far), and what is left of the distance where depth is reversed.
  const ratio = near / far;
  const [along, constant] = reversed ? [-ratio, near] : [1, -near];
  const z = scaled(sum(scaled(w, along), [0, 0, 0, constant]), 1 / (1 - ratio));
  const clipFromWorld = transposed([scaled(row(right), across), scaled(row(up), across), z, w]);
  return { clipFromWorld, depth, layer: 0, region: regionOf(tile), guard, border: 'sharp', channel: 0 };
}

// Checks that a view whose planes and range begin at a distance along its axis begins in front of all casters: in its corners they are
// farthest from the light at that distance.
function checkNearestCaster(distance, begins, across) {
  if (distance === undefined || distance === null) return;
  check(distance > 0, 'a point light', 'nearest_caster', distance, 'above 0');
  const along = distance / Math.sqrt(1 + 2 / (across * across));
  if (begins <= along) return;
  const message =
    `a caster ${distance} from the light may lie ${along} along the axis of a view, which begins at ${begins} (its near plane and its ` +
    'range); let them begin no farther away than the caster, or move the caster';
  throw new ValueError('nearest_caster', message);
}
