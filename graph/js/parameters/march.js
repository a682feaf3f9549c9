// Marched scattering: the structs of the nodes `march_scattering` and `upsample_scattering`.

import { sizeOf } from './area_light.js';
import { depthConversion, kindOf } from './depth_conversion.js';
import { leakReduction } from './leak_reduction.js';
import { normalized } from './light_axes.js';
import { checkMatrix, checkSize, completed, momentDepthRow } from './light_view.js';
import { columns, inverse, product, row, transposed } from './matrix.js';
import { isNormal, single } from './rounding.js';
import { PLACE_ERROR, checkBorder } from './tile.js';
import { ValueError, check } from './value_error.js';
import { cross, difference, dot, isFinite, length, scaled, sum } from './vector.js';
import { eyeOf, positionRows } from './view_parameters.js';

// The largest number that shaders are given.
const LARGEST = 1e9;

// What steps turn by from frame to frame: the smaller part of the golden section.
const GOLDEN = 0.6180339887498949;

// The radius of a light without a size, as a part of the distance up to which light is scattered.
const SMALLEST_RADIUS = 1 / 1024;

// The narrowest border of a cone, as a difference of cosines.
const NARROWEST = 1e-3;

/** A medium of the same density everywhere. */
export const NO_FOG = Object.freeze({ up: [0, 1, 0], height: 0, falloff: 0 });

/**
 * The parameters of `march_scattering` for a perspective camera with surfaces and sky up to the distance `far` along its axis, for a
 * view of a light and a medium; the irradiance of a light with a position is that at distance 1.
 *
 * `air` has a `fog` that thins with height, `{ up, height, falloff }`; the `cone` of a spot, `{ inner, outer }`, full angles in radians;
 * the number of the `frame`; and `own`, four numbers for a density of your own. All can be left out.
 */
export function marchParameters(camera, far, light, medium, air = {}, reduction = leakReduction()) {
  const { fog = NO_FOG, cone, frame = 0, own = [0, 0, 0, 0] } = air;
  const rays = raysOf(camera, far);
  const punctual = punctualLight(light, cone, rays.eye, far);
  const { clip, depth, region, guard, border, layer } = completed(light);
  checkBorder(guard, border, region.extent);
  const [x, y, w] = [0, 1, 3].map((index) => row(clip, index));
  // u = (x + w) / 2, v = (w - y) / 2, both still times w.
  const rows = [scaled(sum(w, x), 0.5), scaled(difference(w, y), 0.5), w, momentDepthRow(depth, clip)];
  const moved = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [...rays.eye, 1]];
  return {
    position_from_camera: rays.position.map((components) => components.map(single)),
    scene_w_from_camera: rays.sceneW.map(single),
    medium,
    fog: fogView({ ...NO_FOG, ...fog }, rays.eye),
    light: punctual,
    map_from_position: product(transposed(rows), moved).map((column) => column.map(single)),
    leak_reduction: reduction,
    conversion: depthConversion(depth),
    region,
    eye: rays.eye.map(single),
    farthest_w: rays.farthestW,
    own: own.map(single),
    offset: single((frame * GOLDEN) % 1),
    guard: single(Math.max(guard - PLACE_ERROR, 0)),
    layer,
  };
}

/** The parameters of `upsample_scattering` for the same camera. */
export function upsampleParameters(camera, far) {
  const { sceneW, farthestW } = raysOf(camera, far);
  return { scene_w_from_camera: sceneW.map(single), farthest_w: farthestW };
}

// The view rays of a perspective camera.
function raysOf(camera, far) {
  const worldFromClip = inverse(columns(camera.clipFromWorld, 'camera'), 'camera');
  const legal = "above 0 and at most 1e9: how far along the camera's axis light is scattered";
  check(far > 0 && far <= LARGEST, 'the far end of scattering', 'far', far, legal);
  const meeting = worldFromClip[2];
  if (Math.abs(meeting[3]) <= 1e-12 * length(meeting.slice(0, 3)) || meeting[3] === 0) {
    const message =
      'the camera is orthographic; scattered light is marched along view rays that meet in the camera: use a perspective camera';
    throw new ValueError('camera', message);
  }
  const position = positionRows(worldFromClip);
  const sceneW = row(worldFromClip, 3);
  // Along x, y and from the middle; depth has no part in a direction.
  const along = [0, 1, 3].map((column) => position.map((components) => components[column]));
  const farthestW = single(Math.abs(dot(unit(cross(along[0], along[1])), along[2])) / far);
  if (!(isNormal(farthestW) && isFinite([...position, sceneW].flat().map(single)))) {
    throw new ValueError('frustum', "the frustum's size is beyond single precision; choose another unit of length");
  }
  return { eye: eyeOf(worldFromClip), position, sceneW, farthestW };
}

// Length 1, or 0 where there is no direction.
const unit = (vector) => {
  const factor = 1 / length(vector);
  return Number.isFinite(factor) && factor > 0 ? scaled(vector, factor) : vector.map(() => 0);
};

function fogView({ up, height, falloff }, eye) {
  const of = 'height fog';
  const upwards = normalized(up);
  if (!upwards) throw new ValueError('up', `${of}: up is ${up}, but must be finite and not zero: which way is up`);
  check(falloff >= 0 && falloff <= LARGEST, of, 'falloff', falloff, 'at least 0 and at most 1e9');
  check(Number.isFinite(height), of, 'height', height, 'finite');
  const above = dot(upwards, eye) - height;
  return {
    gradient: scaled(upwards, falloff).map(single),
    log_density: single(-Math.min(Math.max(falloff * above, -LARGEST), LARGEST)),
  };
}

function punctualLight(light, cone, eye, far) {
  const { clip, depth, size } = completed(light);
  const alongDepth = inverse(clip, 'light')[2];
  checkMatrix(depth, clip);
  checkSize(depth, size);
  if (kindOf(depth)[0] === 'orthographic') {
    if (cone) throw new ValueError('cone', 'the light has parallel rays, but a cone is given; spots have perspective views');
    const away = scaled(alongDepth.slice(0, 3), dot(momentDepthRow(depth, clip), alongDepth));
    return { place: unit(away).map(single), radius: 0, cone_axis: [0, 0, 0], cone_offset: 1 };
  }
  // Its rays meet in what depth alone leads to.
  const position = alongDepth.slice(0, 3).map((entry) => entry / alongDepth[3]);
  const [kind, value] = sizeOf(size);
  const sides = kind === 'point' ? [0, 0] : kind === 'disk' ? [value, value] : value;
  for (const side of sides) check(side >= 0 && side <= LARGEST, 'a light', 'size', side, 'at least 0 and at most 1e9');
  const radius = 0.5 * Math.min(...sides);
  const lamp = { place: difference(position, eye).map(single), radius: single(Math.max(radius, SMALLEST_RADIUS * far)) };
  if (!cone) return { ...lamp, cone_axis: [0, 0, 0], cone_offset: 1 };
  const scale = coneScale(cone);
  const axis = scaled(unit(row(clip, 3).slice(0, 3)), scale);
  return { ...lamp, cone_axis: axis.map(single), cone_offset: single(-scale * Math.cos(0.5 * cone.outer)) };
}

// One over the difference of the cosines of half the angles.
function coneScale({ inner, outer }) {
  const of = 'the cone of a spot';
  check(inner >= 0 && inner < Math.PI, of, 'inner', inner, 'from 0 to below pi radians');
  check(outer > inner && outer < Math.PI, of, 'outer', outer, 'above the inner angle and below pi radians');
  return 1 / Math.max(Math.cos(0.5 * inner) - Math.cos(0.5 * outer), NARROWEST);
}
