// The axes of a light.

import { ValueError } from './value_error.js';
import { cross, difference, dot, isFinite, largest, length, scaled } from './vector.js';

/** The vector scaled to length 1; nothing if it is zero or not finite. */
export function normalized(vector) {
  const most = largest(vector);
  if (!(most > 0 && isFinite(vector))) return undefined;
  const even = vector.map((component) => component / most);
  return scaled(even, 1 / length(even));
}

/** Right-handed axes, the last of which is where light travels to, a direction of any length. */
export function lightAxes(lightDirection) {
  const light = normalized(lightDirection);
  if (!light) {
    const message = `the light's direction is ${lightDirection}, but must be finite and not zero: where light travels to`;
    throw new ValueError('light_direction', message);
  }
  // The axis of the scene that is least along the light.
  const [x, y, z] = light.map(Math.abs);
  const smallest = z < Math.min(x, y) ? 2 : y < x ? 1 : 0;
  const other = [0, 1, 2].map((axis) => (axis === smallest ? 1 : 0));
  // Before it is normalised its length is at least sqrt(2 / 3).
  const across = difference(other, scaled(light, dot(other, light)));
  const first = scaled(across, 1 / length(across));
  return [first, cross(light, first), light];
}
