// What a camera sees between two distances.

import { columns, inverse, row, singular } from './matrix.js';
import { difference, dot, isFinite, length, scaled, sum } from './vector.js';

const CORNERS = [[-1, -1], [1, -1], [-1, 1], [1, 1]];

/**
 * A function that gives a sphere around what lies between two distances along a camera's axis. Its radius does not depend on where the
 * camera is and looks.
 */
export function sphereOf(camera) {
  const edges = edgesOf(camera);
  if (!isFinite(edges.flat(2))) throw singular('camera');
  const mean = (index) => scaled(edges.map((edge) => edge[index]).reduce(sum, [0, 0, 0]), 0.25);
  const [origin, axis] = [mean(0), mean(1)];
  // Relative to the origin, which may be far away.
  const near = edges.map(([start, step]) => [difference(start, origin), step]);
  const spread = near.reduce((most, [, step]) => {
    const off = difference(step, axis);
    return Math.max(most, dot(off, off));
  }, 0);
  return ([first, last]) => {
    // As far from the corners in front as from those behind, unless those behind alone are so far apart.
    const middle = Math.min(0.5 * (first + last) * (1 + spread), last);
    const distance = ([start, step], at) => length(difference(sum(start, scaled(step, at)), scaled(axis, middle)));
    const radius = near.reduce((most, edge) => Math.max(most, distance(edge, first), distance(edge, last)), 0);
    return { centre: sum(origin, scaled(axis, middle)), radius };
  };
}

// The edges of the frustum. At the distance `t` along the camera's axis an edge is at `start + t step`.
function edgesOf(camera) {
  const clip = columns(camera.clipFromWorld, 'camera');
  const [x, y, z, middle] = inverse(clip, 'camera');
  const axis = row(clip, 3).slice(0, 3);
  const parallel = axis.every((entry) => entry === 0);
  return CORNERS.map(([across, up]) => {
    const atZero = sum(sum(scaled(x, across), scaled(y, up)), middle);
    if (parallel) {
      const near = sum(atZero, scaled(z, 1 - camera.farDepth));
      const along = scaled(z.slice(0, 3), (2 * camera.farDepth - 1) * Math.sign(near[3]));
      return [near.slice(0, 3).map((value) => value / near[3]), scaled(along, 1 / length(along))];
    }
    // All rays meet where clip x, y and w are 0. A position less that one, times its homogeneous coordinate, does not depend on depth.
    const eye = z.slice(0, 3).map((value) => value / z[3]);
    const along = difference(atZero.slice(0, 3), scaled(eye, atZero[3]));
    return [eye, scaled(along, length(axis) / dot(axis, along))];
  });
}
