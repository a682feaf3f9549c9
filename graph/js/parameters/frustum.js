// What a camera sees between two distances.

import { columns, singular, transposed } from './matrix.js';
import { cross, difference, dot, isFinite, length, scaled, sum } from './vector.js';

// The smallest volume that three directions of length 1 span: those of a picture that is not flat.
const SMALLEST_VOLUME = 1e-9;

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

// The edges of the frustum. At the distance `t` along the camera's axis an edge is at `start + t step`; distances count from the camera, or,
// where its rays are parallel, from its near plane.
function edgesOf(camera) {
  const clip = columns(camera.clipFromWorld, 'camera');
  const [x, y, z, w] = transposed(clip);
  const parallel = w.slice(0, 3).every((entry) => entry === 0);
  const given = [x, y, parallel ? z : w];
  const [a, b, c] = given.map((entries) => entries.slice(0, 3));
  const constants = given.map((entries) => entries[3]);
  const volume = dot(a, cross(b, c));
  const spans = Math.abs(volume) > SMALLEST_VOLUME * length(a) * length(b) * length(c);
  if (!(spans && isFinite(clip.flat()))) throw singular('camera');
  // The place with these three coordinates.
  const solved = (at) => scaled(sum(sum(scaled(cross(b, c), at[0]), scaled(cross(c, a), at[1])), scaled(cross(a, b), at[2])), 1 / volume);
  const far = camera.farDepth;
  return CORNERS.map(([across, up]) => {
    if (parallel) {
      const near = solved(difference(scaled([across, up, 1 - far], w[3]), constants));
      const along = solved([0, 0, (2 * far - 1) * w[3]]);
      return [near, scaled(along, 1 / length(along))];
    }
    return [solved(scaled(constants, -1)), scaled(solved([across, up, 1]), length(c))];
  });
}
