// The rectified coordinates of a camera and a directional light: the struct `RectifiedFrame`.

import { lightAxes, normalized } from './light_axes.js';
import { columns, inverse, singular } from './matrix.js';
import { isNormal, single, whole } from './rounding.js';
import { ValueError } from './value_error.js';
import { cross, difference, dot, isFinite, length, scaled, sum } from './vector.js';

const TAU = 2 * Math.PI;

// The margin by which bounds grow, so that coordinates in single precision stay inside: relative for radii, in radians for angles.
const MARGIN = 2e-6;

// A direction this close to a side plane (the sine of the angle) counts as inside: too many rows are harmless.
const INSIDE = 1e-6;

/**
 * The frame of a perspective camera and a light that travels along `lightDirection` (of any length); `far` is the finite distance
 * along the camera's axis up to which light is scattered. Gives the camera's position, the frame's axes in the scene and the struct.
 */
export function rectifiedView(clipFromWorld, far, lightDirection) {
  const worldFromClip = inverse(columns(clipFromWorld, 'camera'), 'camera');
  if (!(far > 0 && Number.isFinite(far))) {
    const message = `the far distance is ${far}, but must be above 0 and finite: how far along the camera's axis light is scattered`;
    throw new ValueError('far', message);
  }
  const axes = lightAxes(lightDirection);
  // All view rays meet where clip x, y and w are 0.
  const [x, y, z, middle] = worldFromClip;
  if (Math.abs(z[3]) <= 1e-12 * length(z.slice(0, 3)) || z[3] === 0) {
    const message =
      'the camera is orthographic; rectified coordinates need view rays that meet in the camera: use a perspective camera, or march ' +
      'the scattering';
    throw new ValueError('camera', message);
  }
  const camera = z.slice(0, 3).map((component) => component / z[3]);
  // A position less the camera's, times its homogeneous coordinate, is linear in x and y and independent of depth.
  const direction = (column) => {
    const scene = difference(column.slice(0, 3), scaled(camera, column[3]));
    return axes.map((axis) => dot(axis, scene));
  };
  const along = [x, y, middle].map(direction);
  const normal = normalized(cross(along[0], along[1]));
  if (!normal) throw singular('camera');
  const farthest = Math.abs(dot(normal, along[2])) / far;
  const bounds = boundsOf(along.map((vector) => vector.map((component) => component / farthest)));
  const frame = {
    along_x: along[0].map(single),
    largest_radius: single(bounds.radius),
    along_y: along[1].map(single),
    first_azimuth: single(bounds.azimuth[0]),
    along_middle: along[2].map(single),
    azimuth_extent: single(bounds.azimuth[1] - bounds.azimuth[0]),
    scene_w: [x[3], y[3], z[3], middle[3]].map(single),
    farthest_w: single(farthest),
    smallest_inclination: single(bounds.inclination[0]),
    largest_inclination: single(bounds.inclination[1]),
  };
  if (!(isNormal(frame.farthest_w) && isNormal(frame.largest_radius) && isFinite(Object.values(frame).flat()))) {
    throw new ValueError('frustum', "the frustum's size is beyond single precision; choose another unit of length");
  }
  return { camera, axes, frame };
}

// The bounds of the frustum whose far plane is spanned by the changes of position there along x and y, and their middle.
function boundsOf(along) {
  const ends = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const corners = ends.map(([x, y]) => sum(sum(scaled(along[0], x), scaled(along[1], y)), along[2]));
  const edges = corners.map((corner, index) => [corner, corners[(index + 1) % 4]]);
  const inside = [1, -1].map((sign) =>
    edges.every(([from, to]) => {
      const normal = cross(from, to);
      const inner = signum(dot(normal, along[2]));
      return inner * sign * normal[2] >= -INSIDE * length(normal);
    }),
  );
  const radius = corners.map(([x, y]) => Math.hypot(x, y)).reduce(larger, 0);
  return { radius: radius * (1 + MARGIN), azimuth: azimuths(corners, along[2], inside), inclination: inclinations(edges, inside) };
}

const signum = (value) => (value < 0 || Object.is(value, -0) ? -1 : 1);
// A number that is none is left out.
const larger = (most, value) => (value > most ? value : most);
const smaller = (least, value) => (value < least ? value : least);

function azimuths(corners, middle, inside) {
  if (inside[0] || inside[1]) return [0, TAU];
  // Seen along the light the frustum is a wedge of less than half a turn that contains its middle.
  const about = Math.atan2(middle[1], middle[0]);
  const offsets = corners.map(([x, y]) => {
    const offset = Math.atan2(y, x) - about;
    return offset - TAU * whole(offset / TAU);
  });
  return [about + (offsets.reduce(smaller, 0) - MARGIN), about + (offsets.reduce(larger, 0) + MARGIN)];
}

function inclinations(edges, inside) {
  const inclination = ([x, y, z]) => Math.atan2(Math.hypot(x, y), z);
  let low = inside[0] ? 0 : Math.PI;
  let high = inside[1] ? Math.PI : 0;
  for (const [from, to] of edges) {
    const step = difference(to, from);
    // Where the inclination is extremal on the line of the edge.
    const [onto, square] = [dot(from, step), dot(step, step)];
    const t = (from[2] * onto - step[2] * dot(from, from)) / (step[2] * onto - from[2] * square);
    const points = t >= 0 && t <= 1 ? [from, sum(from, scaled(step, t))] : [from];
    for (const point of points) {
      low = smaller(low, inclination(point));
      high = larger(high, inclination(point));
    }
  }
  return [larger(0, low - MARGIN), smaller(Math.PI, high + MARGIN)];
}
