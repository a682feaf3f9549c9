// Everything that passes are told per view: makers of the structs of the library's nodes, and where they go in a view's block.

export { areaLight, depthPerTexel, depthRange, texelSize } from './parameters/light_view.js';
export { NO_AREA, areaLightOf } from './parameters/area_light.js';
export { checkPlaces, placeViews } from './parameters/atlas.js';
export { initialBlock, write, writeRegions } from './parameters/block.js';
export { cascadeSlices, cascadeViews } from './parameters/cascades.js';
export { CONTACT_SHADOWS, contactShadowParameters } from './parameters/contact_shadow.js';
export { depthConversion } from './parameters/depth_conversion.js';
export { blurParameters, deviationOfWidth, gaussianKernel, kernelFromWeights, kernelOfWidth, standardDeviation } from './parameters/kernel.js';
export { leakReduction } from './parameters/leak_reduction.js';
export { NO_FOG, marchParameters, upsampleParameters } from './parameters/march.js';
export { NONE, WHOLE } from './parameters/map_region.js';
export { pointLightFaces, spotView } from './parameters/point_light.js';
export { NO_BIAS, biasForStoredDepth, receiverBias } from './parameters/receiver_bias.js';
export { rectifiedView } from './parameters/rectified_view.js';
export { medium, scatteringParameters } from './parameters/scattering.js';
export { structBytes } from './parameters/struct.js';
export { guardOf } from './parameters/tile.js';
export { ValueError } from './parameters/value_error.js';
export { viewParameters } from './parameters/view_parameters.js';
