// Where camera and sun are, for the pages and for whoever draws their picture elsewhere.

import { parallel, perspective } from './matrix.js';

/** What the sun's map covers: as many scene units to each side of the origin. */
export const REACH = 10;

/** What the camera looks at, and how near: the cotangent of half of the picture's shorter angle. */
export const TARGET = [0.4, 1.5, 0];
export const ZOOM = 1.6;

/** The direction to a sun that is `angle` radians about the scene. */
export function sunTowards(angle) {
  const towards = [Math.sin(angle), 0.75, Math.cos(angle)];
  const length = Math.hypot(...towards);
  return towards.map((value) => value / length);
}

/** For a camera at `eye`, that sun, and a picture of a size. */
export function view({ eye, angle, size: [width, height] }) {
  const towardsSun = sunTowards(angle);
  const clipFromWorld = perspective(eye, TARGET, { aspect: width / height, zoom: ZOOM });
  return { towardsSun, sun: parallel(towardsSun, REACH), camera: { clipFromWorld, farDepth: 0 } };
}
