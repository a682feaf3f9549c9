// Where regions lie in the layers of a map: `{ size, layers }`.

import { isWhole, overlap } from './map_region.js';
import { checkBorder } from './tile.js';
import { ValueError } from './value_error.js';

/**
 * Gives each view a layer and a place there; its region's extent stays. Largest first, equal ones in their order, so that views of the
 * same extents always have the same places. Views that each have as many texels as the map get a layer each.
 */
export function placeViews({ size, layers }, views) {
  views.forEach(({ region }, index) => {
    if (region && !isWhole(region) && region.extent.every((texels) => texels > 0)) return;
    const message = `view ${index} has no extent that could be placed; give its region as many texels as it is to have`;
    throw new ValueError('region', message);
  });
  const extentOf = (index) => views[index].region.extent;
  const order = views.map((_, index) => index).sort((a, b) => Math.max(...extentOf(b)) - Math.max(...extentOf(a)));
  const count = Math.min(layers, views.length);
  const free = Array.from({ length: count }, (_, layer) => ({ layer, region: { origin: [0, 0], extent: size } }));
  const placed = [...views];
  for (const index of order) {
    const place = take(free, extentOf(index));
    if (!place) {
      const message =
        `a map of ${size.join('x')} texels and ${layers} layers has no room for view ${index} of ${views.length} with ` +
        `${extentOf(index).join('x')} texels; give it more layers or texels, or views fewer`;
      throw new ValueError('map', message);
    }
    placed[index] = { ...views[index], ...place };
  }
  return placed;
}

/** Checks views that a page has placed: each lies in the map, has texels within its guard band and room for its border, and none with another one. */
export function checkPlaces({ size, layers }, views) {
  views.forEach((view, index) => {
    const { layer, region, guard = 0, border } = view;
    const fits = [0, 1].every((axis) => region.extent[axis] > 0 && region.origin[axis] + region.extent[axis] <= size[axis]);
    if (layer >= layers || !(fits || isWhole(region))) {
      const message =
        `view ${index} lies in layer ${layer} at ${region.origin} with ${region.extent} texels, which is not within a map of ` +
        `${size.join('x')} texels and ${layers} layers`;
      throw new ValueError('region', message);
    }
    checkBorder(guard, border, isWhole(region) ? size : region.extent);
    const first = views.slice(0, index).findIndex((other) => other.layer === layer && overlap(other.region, region));
    if (first < 0) return;
    const message = `views ${first} and ${index} overlap in layer ${layer}; each texel belongs to one region`;
    throw new ValueError('region', message);
  });
}

// Takes a rectangle from the free one that leaves the least along one side, and of equal ones the first.
function take(free, extent) {
  const left = ({ region }) => [0, 1].map((axis) => region.extent[axis] - extent[axis]);
  const tightness = (rest) => (Math.min(...rest) < 0 ? Infinity : Math.min(...rest));
  const rests = free.map((each) => tightness(left(each)));
  const index = rests.indexOf(Math.min(...rests));
  if (index < 0 || rests[index] === Infinity) return undefined;
  const { layer, region } = free[index];
  const [across, down] = left(free[index]);
  const [x, y] = region.origin;
  // The larger rest stays whole.
  const [height, width] = across > down ? [region.extent[1], extent[0]] : [extent[1], region.extent[0]];
  const parts = [
    { origin: [x + extent[0], y], extent: [across, height] },
    { origin: [x, y + extent[1]], extent: [width, down] },
  ];
  const filled = parts.filter((part) => Math.min(...part.extent) > 0).map((part) => ({ layer, region: part }));
  // In the place of what they were taken from, so that layers are filled one after the other.
  free.splice(index, 1, ...filled);
  return { layer, region: { origin: [x, y], extent } };
}
