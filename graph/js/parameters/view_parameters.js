// What nodes that shade a picture need to know of a view of a light: the struct `ViewParameters` of `shade_hard` and `shade_soft`.

import { NO_AREA } from './area_light.js';
import { depthConversion } from './depth_conversion.js';
import { leakReduction } from './leak_reduction.js';
import { checkMatrix, completed, momentDepthRow } from './light_view.js';
import { columns, inverse, product, row, transposed } from './matrix.js';
import { single } from './rounding.js';
import { PLACE_ERROR, borderOf, checkBorder } from './tile.js';
import { check, number } from './value_error.js';
import { difference, scaled, sum } from './vector.js';

// A width in texels in sixteenths, rounded as Rust does: halves away from zero.
const sixteenths = (texels) => Math.floor(16 * texels + 0.5);

/** What positions are relative to: rays of a perspective camera meet in what depth alone leads to, those of another begin at its near plane. */
export function eyeOf(worldFromClip) {
  const eye = worldFromClip[2][3] !== 0 ? worldFromClip[2] : worldFromClip[3];
  return [0, 1, 2].map((axis) => eye[axis] / eye[3]);
}

/** The rows that give a scene position relative to the camera, times its homogeneous coordinate, of clip coordinates. */
export function positionRows(worldFromClip) {
  const [eye, sceneW] = [eyeOf(worldFromClip), row(worldFromClip, 3)];
  return [0, 1, 2].map((axis) => difference(row(worldFromClip, axis), scaled(sceneW, eye[axis])));
}

/**
 * The parameters of a camera that looks at receivers of a light's shadow.
 *
 * The camera has `clipFromWorld`, as WebGPU's clip space has it, and `farDepth`, the stored depth of pixels that show no surface: 0 for
 * reversed depth, 1 otherwise. `areaLight` is for soft shadows.
 */
export function viewParameters(camera, light, receiverBias, reduction = leakReduction(), areaLight = NO_AREA) {
  const worldFromClip = inverse(columns(camera.clipFromWorld, 'camera'), 'camera');
  const { clip, depth, region, guard, border, layer, channel } = completed(light);
  inverse(clip, 'light');
  const conversion = depthConversion(depth);
  checkMatrix(depth, clip);
  checkBorder(guard, border, region.extent);
  check(Number.isInteger(channel) && channel >= 0 && channel < 16, 'a light', 'channel', channel, '0 to 15');
  const { width, flags } = borderOf(border);
  const [x, y, w] = [0, 1, 3].map((index) => row(clip, index));
  // From clip space to the map: u = (x + w) / 2, v = (w - y) / 2, both still times w.
  const rows = [scaled(sum(w, x), 0.5), scaled(difference(w, y), 0.5), w, momentDepthRow(depth, clip)];
  const position = positionRows(worldFromClip);
  return {
    light_from_camera: product(transposed(rows), worldFromClip).map((column) => column.map(single)),
    scene_w_from_camera: row(worldFromClip, 3).map(single),
    position_from_camera: position.map((components) => components.map(single)),
    receiver_bias: receiverBias,
    leak_reduction: reduction,
    region,
    far_depth: single(number("the camera's farDepth", camera.farDepth)),
    layer,
    channel: (channel | flags | (sixteenths(width) << 16)) >>> 0,
    guard: single(Math.max(guard - PLACE_ERROR, 0)),
    conversion,
    light: areaLight,
  };
}
