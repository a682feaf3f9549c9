// Regions of a map: the rectangles of an atlas, in texels of mip level 0.

const MOST = 0xffffffff;

/** All of a layer, whatever its size. */
export const WHOLE = Object.freeze({ origin: [0, 0], extent: [MOST, MOST] });

/** No region: of a view that there is not. */
export const NONE = Object.freeze({ origin: [0, 0], extent: [0, 0] });

/** Whether a region is all of its layer. */
export const isWhole = ({ origin, extent }) => origin.every((at) => at === 0) && extent.every((texels) => texels === MOST);

/** Whether two regions have a texel in common. */
export const overlap = (a, b) =>
  [0, 1].every((axis) => {
    const end = (region) => region.origin[axis] + region.extent[axis];
    return Math.max(a.origin[axis], b.origin[axis]) < Math.min(end(a), end(b));
  });
