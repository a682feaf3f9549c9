// Matrices of 16 numbers, column after column, in WebGPU's clip space.

const subtract = (a, b) => a.map((value, axis) => value - b[axis]);
const dot = (a, b) => a.reduce((sum, value, axis) => sum + value * b[axis], 0);
const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay];
const unit = (vector) => vector.map((value) => value / Math.hypot(...vector));
const byRows = (rows) => [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));

// Right, up and forward of who looks from `eye` at `target`.
function axes(eye, target) {
  const forward = unit(subtract(target, eye));
  const right = unit(cross(forward, [0, 1, 0]));
  return [right, cross(right, forward), forward];
}

/** A camera with reversed depth: 1 at the distance `near`, 0 infinitely far away. */
export function perspective(eye, target, { aspect, zoom, near = 0.1 }) {
  const [right, up, forward] = axes(eye, target);
  const along = (axis, factor) => [...axis.map((value) => factor * value), -factor * dot(axis, eye)];
  return byRows([along(right, zoom / Math.max(aspect, 1)), along(up, zoom * Math.min(aspect, 1)), [0, 0, 0, near], along(forward, 1)]);
}

/** A light with parallel rays towards the origin: `reach` scene units to each side, and as many before and behind it. */
export function parallel(towards, reach) {
  const [right, up, forward] = axes(towards, [0, 0, 0]);
  const along = (axis, factor, summand) => [...axis.map((value) => (factor * value) / reach), summand];
  return byRows([along(right, 1, 0), along(up, 1, 0), along(forward, 0.5, 0.5), [0, 0, 0, 1]]);
}
