// What shadows at contacts need to know of a light: the struct `ContactShadowParameters` of `contact_shadows`.

import { kindOf } from './depth_conversion.js';
import { checkMatrix, completed, momentDepthRow } from './light_view.js';
import { columns, inverse, row, transformed } from './matrix.js';
import { isNormal, single } from './rounding.js';
import { check, number } from './value_error.js';
import { difference, dot, length, scaled, sum } from './vector.js';
import { eyeOf, positionRows } from './view_parameters.js';

// No march is longer: products of it and of directions stay finite.
const LONGEST = 1e18;

/** How far shadows at contacts reach, for scenes in metres: 6 cm, and surfaces of 2 cm. */
export const CONTACT_SHADOWS = { length: 0.06, thickness: 0.02 };

/**
 * The parameters of a camera that looks at receivers of a light's shadow. Of a light with several views, any of them says where it is.
 *
 * `contact` has a `length`, how far a surface looks for what stands between it and the light, and a `thickness` of surfaces whose backs
 * the camera does not see, both in scene units.
 */
export function contactShadowParameters(camera, light, contact = CONTACT_SHADOWS) {
  for (const name of ['length', 'thickness']) {
    const value = contact[name];
    const valid = value > 0 && isNormal(value) && value <= LONGEST;
    check(valid, 'shadows at contacts', name, value, 'above 0, at most 1e18, and normal in single precision');
  }
  const clip = columns(camera.clipFromWorld, 'camera');
  const farDepth = number("the camera's farDepth", camera.farDepth);
  const worldFromClip = inverse(clip, 'camera');
  const { clip: lightFromWorld, depth } = completed(light);
  const alongDepth = inverse(lightFromWorld, 'light')[2];
  checkMatrix(depth, lightFromWorld);
  let [lightClip, lightPosition] = [null, [0, 0, 0, 0]];
  if (kindOf(depth)[0] === 'orthographic') {
    const away = scaled(alongDepth.slice(0, 3), dot(momentDepthRow(depth, lightFromWorld), alongDepth));
    lightClip = transformed(clip, [...normalized(away).map((entry) => -entry), 0]);
  } else {
    // Its rays meet in what depth alone leads to.
    const position = alongDepth.map((entry) => entry / alongDepth[3]);
    lightClip = transformed(clip, position);
    lightPosition = [...difference(position.slice(0, 3), eyeOf(worldFromClip)), 1];
  }
  const sceneW = row(worldFromClip, 3);
  const position = positionRows(worldFromClip);
  const axis = axisOf(clip, farDepth);
  const distance = position.map((components, index) => scaled(components, axis[index])).reduce(sum);
  return {
    light_clip: lightClip.map(single),
    light_position: lightPosition.map(single),
    position_from_camera: position.map((components) => components.map(single)),
    scene_w_from_camera: sceneW.map(single),
    depth_scale: single(distance[2] * sceneW[3] - distance[3] * sceneW[2]),
    length: single(contact.length),
    thickness: single(contact.thickness),
    far_depth: single(farDepth),
  };
}

// Length 1, or 0 where there is no direction.
const normalized = (vector) => {
  const inverseLength = 1 / length(vector);
  return Number.isFinite(inverseLength) && inverseLength > 0 ? scaled(vector, inverseLength) : vector.map(() => 0);
};

// Where the camera looks.
function axisOf(clip, farDepth) {
  const last = row(clip, 3);
  const axis = last.slice(0, 3);
  if (axis.some((entry) => entry !== 0)) return normalized(axis);
  // Parallel view rays: depth grows, or falls where it is reversed.
  return normalized(scaled(row(clip, 2).slice(0, 3), farDepth < 0.5 ? -last[3] : last[3]));
}
