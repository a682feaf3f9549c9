import type { Plan, PlannedField } from './plan.js';

/** By columns: four arrays of four numbers, or 16 numbers. */
export type Matrix = ArrayLike<number> | ArrayLike<ArrayLike<number>>;
export type Pair = [number, number];
export type Triple = [number, number, number];

/** Distances along the light's axis that map to the moment depths -1 and 1. */
export interface DepthRange {
  near: number;
  far: number;
}

export interface MapRegion {
  origin: Pair;
  extent: Pair;
}

/** How a light's map stores depth. */
export type LightDepth =
  | { orthographic: { reversed?: boolean } }
  | { perspective: { near: number; far: number; reversed?: boolean; range: DepthRange } }
  | { linear: { range: DepthRange } };

/** How large a light is; left out, a point. */
export type LightSize = { angularDiameter: number } | { disk: number } | { rectangle: Pair };

export interface CameraView {
  clipFromWorld: Matrix;
  /** The stored depth of pixels that show no surface: 0 for reversed depth, 1 otherwise. */
  farDepth: number;
}

/**
 * What becomes of shadows along the border of what a view shows, within its guard band, over a width in texels of its region: the next view
 * takes over; it blends with the next ones that contain a place; shadows fade out; or they do so towards a spot's cone.
 */
export type Border = 'sharp' | { blend: number } | { fade: number } | { cone: number };

/** What one region of a light's map was drawn with. Without more than a matrix it is that of a sun without size. */
export interface LightView {
  clipFromWorld: Matrix;
  depth?: LightDepth;
  layer?: number;
  region?: MapRegion;
  /** Texels along the region's edges that are drawn and filtered, but in which nodes that shade look up no place. */
  guard?: number;
  /** What becomes of shadows along the border of what it shows. */
  border?: Border;
  channel?: number;
  size?: LightSize;
}

/** A light's view with nothing left out but a size: what is made here. */
export type PlacedView = Required<Omit<LightView, 'size'>>;

/** The square region that each view gets, and how many texels the graph's filters reach to each side. */
export interface Tile {
  texels: number;
  filterRadius: number;
}

/** Where cascades end: so many between uniform, 0, and logarithmic, 1, or at given distances, one less than there are cascades. */
export type CascadeSplits = { blend: { count: number; logarithmic: number } } | { given: number[] };

/** The cascades of a sun. Distances count along the camera's axis. */
export interface Cascades {
  /** Where light travels to. */
  direction: Triple;
  splits: CascadeSplits;
  near: number;
  far: number;
  /** How far a cascade reaches into the next one, as a part of its own length; 0 where it is left out. */
  overlap?: number;
  /** The part of a view's width over which it blends with coarser ones, and the last one fades out, 0 to 0.5. */
  blend?: number;
  /** The lowest and the highest corner of a box around all that casts. */
  casters?: [Triple, Triple];
  /** Whether casters in front of the near plane are clamped to it. */
  pancaking?: boolean;
  reversed?: boolean;
  tile: Tile;
}

/** A light that shines from a point: `depth` is perspective or linear. */
export interface PointLight {
  position: Triple;
  depth: LightDepth;
  tile: Tile;
  /** How far from the light the nearest caster is: views are refused that may begin behind it. */
  nearestCaster?: number;
}

/** A map whose layers views of lights share. */
export interface Atlas {
  size: Pair;
  layers: number;
}

export interface DepthConversion {
  numerator: Pair;
  denominator: Pair;
  scale: number;
  offset: number;
}

export interface ReceiverBias {
  constant: number;
  slope_scale: number;
  maximum: number;
  step: number;
}

export interface LeakReduction {
  full_shadow: number;
  bleed_reduction: number;
  visibility_exponent: number;
}

export interface AreaLight {
  size: Pair;
  near: number;
  far: number;
  perspective: number;
  smallest_radius: number;
  largest_radius: number;
  rectangular: number;
}

export interface SingleScattering {
  extinction: Triple;
  anisotropy: number;
  scattering: Triple;
  mean_extinction: number;
  irradiance: Triple;
}

/** A uniform struct: a value for each of its members, by the names that the plan lists. */
export interface Struct {
  [member: string]: number | ArrayLike<number> | ArrayLike<ArrayLike<number>> | Struct | object;
}

/** A value that is refused: `subject` is what the value is. */
export class ValueError extends Error {
  constructor(subject: string, message: string);
  subject: string;
}

export const WHOLE: MapRegion;
export const NONE: MapRegion;
export const NO_BIAS: ReceiverBias;
export const NO_AREA: AreaLight;

/** The struct of node `resolve`, per layer. */
export function depthConversion(depth: LightDepth): DepthConversion;

/** The struct of nodes `shade_hard` and `shade_soft`, per view of a light. */
export function viewParameters(
  camera: CameraView,
  light: LightView,
  receiverBias: ReceiverBias,
  leakReduction?: LeakReduction,
  areaLight?: AreaLight,
): Struct;

/** How far shadows at contacts reach, and how thick surfaces are whose backs the camera does not see, in scene units. */
export interface ContactShadows {
  length: number;
  thickness: number;
}

/** For scenes in metres: 6 cm, and surfaces of 2 cm. */
export const CONTACT_SHADOWS: ContactShadows;

/** The struct of node `contact_shadows`, per light: any view of a light says where it is. */
export function contactShadowParameters(camera: CameraView, light: LightView, contact?: ContactShadows): Struct;

export function receiverBias(standardDeviation: number, depthPerTexel: number): ReceiverBias;
export function biasForStoredDepth(bias: ReceiverBias, format: GPUTextureFormat, conversion: DepthConversion): ReceiverBias;
export function leakReduction(settings?: { fullShadow?: number; bleedReduction?: number; visibilityExponent?: number }): LeakReduction;

/** The width of a tile's guard band in texels. */
export function guardOf(tile: Tile): number;

/** Where each cascade's part of the frustum begins and ends, its overlap with the next one included. */
export function cascadeSlices(cascades: Cascades): Pair[];

/** The cascades, from near to far. Texels keep their size and stay where they are in the scene while the camera moves and turns. */
export function cascadeViews(cascades: Cascades, camera: CameraView): PlacedView[];

/** The six faces, +x, -x, +y, -y, +z and -z. */
export function pointLightFaces(light: PointLight): PlacedView[];

/** A spot along `direction`; `angle` is the full angle of its cone in radians. */
export function spotView(light: PointLight, direction: Triple, angle: number): PlacedView;

/** The views with a layer and a place in a map each. */
export function placeViews<View extends LightView>(atlas: Atlas, views: View[]): View[];

/** Checks views that a page has placed. */
export function checkPlaces(atlas: Atlas, views: PlacedView[]): void;

/** Width and height of a texel in scene units. `extent` are the texels of the light's region, here and below. */
export function texelSize(light: LightView, extent: Pair): Pair;
export function depthRange(light: LightView): DepthRange;
export function depthPerTexel(light: LightView, extent: Pair): number;

/** The light with its size; search and filter keep to `radii`, the smallest and the largest half width in texels. */
export function areaLight(light: LightView, extent: Pair, radii: Pair): AreaLight;
export function areaLightOf(size: LightSize | undefined, texel: Pair, range: DepthRange, radii: Pair): AreaLight;

export function medium(settings: { extinction: Triple; scattering: Triple; anisotropy?: number; irradiance: Triple }): SingleScattering;

/** The structs of nodes `rectify_moments`, `integrate_scattering` and `composite_scattering`. */
export function scatteringParameters(
  camera: CameraView,
  far: number,
  light: LightView,
  medium: SingleScattering,
): { rectify: Struct; integrate: Struct; composite: Struct };

/** Fog whose density's logarithm falls by `falloff` per scene unit of height; at `height` it is that of the medium. */
export interface HeightFog {
  up?: Triple;
  height?: number;
  falloff?: number;
}

/** What nodes that march are told beside camera, light and medium. */
export interface MarchedAir {
  fog?: HeightFog;
  /** The cone of a spot: full angles in radians, of all its light and of none. */
  cone?: { inner: number; outer: number };
  /** The number of the frame, by which dithered steps turn. */
  frame?: number;
  /** Four numbers for a density of your own. */
  own?: [number, number, number, number];
}

export const NO_FOG: Required<HeightFog>;

/** The struct of a node `march_scattering`, per view of its light. The irradiance of a light with a position is that at distance 1. */
export function marchParameters(
  camera: CameraView,
  far: number,
  light: LightView,
  medium: SingleScattering,
  air?: MarchedAir,
  leakReduction?: LeakReduction,
): Struct;

/** The struct of a node `upsample_scattering`. */
export function upsampleParameters(camera: CameraView, far: number): Struct;

export function rectifiedView(
  clipFromWorld: Matrix,
  far: number,
  lightDirection: Triple,
): { camera: Triple; axes: [Triple, Triple, Triple]; frame: Struct };

/** Weights of a kernel. */
export function gaussianKernel(radius: number, sigma: number): number[];
export function kernelFromWeights(weights: ArrayLike<number>): number[];
/**
 * The weights by which shadows are filtered over a width in scene units: `width` is the standard deviation of the whole filter in
 * texels, the width in scene units divided by a texel's. Its radius is at most `largest`, 64 where it is left out.
 */
export function kernelOfWidth(width: number, largest?: number): number[];
/** The standard deviation of that kernel in texels, for `receiverBias`. */
export function deviationOfWidth(width: number): number;
export function standardDeviation(weights: number[]): number;
/**
 * The struct of a node `blur` whose kernel can change per frame, or has a radius above 12. Where `kernel` has a `width`, two for each
 * region, along x and along y (`kernelOfWidth`).
 */
export function blurParameters(weights: number[]): Struct;

/** A view's block with every node's initial values. */
export function initialBlock(plan: Plan): Uint8Array<ArrayBuffer>;

/** Writes a node's struct, its bytes, or several where the node has an array of them, into a view's block. */
export function write(plan: Plan, block: Uint8Array, node: string, layer: number, values: object | ArrayBufferView | object[]): void;

/** Writes the regions of a map's layer into a view's block. */
export function writeRegions(plan: Plan, block: Uint8Array, map: string, layer: number, regions: MapRegion[]): void;

/** Bytes of a struct. */
export function structBytes(size: number, fields: PlannedField[], value: object): Uint8Array<ArrayBuffer>;
