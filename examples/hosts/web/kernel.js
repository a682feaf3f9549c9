// The kernel of the blur on both pages, and of what it is compared with.

import { gaussianKernel } from 'moment-shadows-graph/parameters.js';

/** A Gaussian that is cut off at `radius` texels: its weights. */
export const kernel = (radius) => gaussianKernel(radius, 0.6 * radius);
