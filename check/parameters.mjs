// The parameters that graph/js makes, byte by byte beside those of the library in Rust.
//
// usage: node parameters.mjs FILE
// FILE is what the example `write_parameters` wrote: random inputs with their bytes, or the name of the value that is refused. What one
// side refuses, the other has to refuse as well, for the same value.

import { readFileSync } from 'node:fs';
import {
  ValueError,
  areaLight,
  biasForStoredDepth,
  blurParameters,
  cascadeSlices,
  cascadeViews,
  contactShadowParameters,
  depthConversion,
  depthPerTexel,
  gaussianKernel,
  initialBlock,
  kernelFromWeights,
  kernelOfWidth,
  leakReduction,
  marchParameters,
  medium,
  placeViews,
  pointLightFaces,
  receiverBias,
  scatteringParameters,
  spotView,
  standardDeviation,
  structBytes,
  upsampleParameters,
  viewParameters,
  write,
  writeRegions,
} from '../graph/js/parameters.js';

const hexadecimal = (bytes) => Buffer.from(bytes).toString('hex');

// JSON has no numbers that are none.
const NUMBERS = { NaN, inf: Infinity, '-inf': -Infinity };
const revive = (_, value) => (typeof value === 'string' && value in NUMBERS ? NUMBERS[value] : value);

// Powers and tangents differ in the last bit.
const viewed = ({ clipFromWorld, layer, region, guard, border }) => [
  clipFromWorld.flat().map(Math.fround),
  layer,
  region.origin,
  region.extent,
  guard,
  border === 'sharp' ? border : Object.fromEntries(Object.entries(border).map(([kind, width]) => [kind, Math.fround(width)])),
];

// For each kind of input, what it makes: text, or an object of texts and numbers.
function makers(plan) {
  const struct = (node, value) => {
    const { size, fields } = plan.parameters.blocks.find((block) => block.node === node);
    return hexadecimal(structBytes(size, fields, value));
  };
  return {
    conversion: (depth) => struct('resolve', depthConversion(depth)),
    view: ({ camera, light, extent, deviation, format, reduction, radii }) => {
      const [fullShadow, bleedReduction, visibilityExponent] = reduction;
      const leaks = leakReduction({ fullShadow, bleedReduction, visibilityExponent });
      const conversion = depthConversion(light.depth);
      const bias = biasForStoredDepth(receiverBias(deviation, depthPerTexel(light, extent)), format, conversion);
      const view = viewParameters(camera, light, bias, leaks);
      return struct('shade', { ...view, light: areaLight(light, extent, radii) });
    },
    contact: ({ camera, light, length, thickness }) =>
      struct('contact', contactShadowParameters(camera, light, { length, thickness })),
    scattering: ({ camera, light, far, anisotropy, extinction, scattering, irradiance }) => {
      const made = scatteringParameters(camera, far, light, medium({ extinction, scattering, anisotropy, irradiance }));
      return Object.fromEntries(Object.entries(made).map(([node, value]) => [node, struct(node, value)]));
    },
    march: ({ camera, light, far, colour, air }) => {
      const given = medium({ extinction: colour, scattering: colour, anisotropy: 0.5, irradiance: colour });
      const made = marchParameters(camera, far, light, given, { ...air, cone: air.cone ?? undefined });
      return { march: struct('march', made), upsample: struct('upsample', upsampleParameters(camera, far)) };
    },
    blur: ({ radius, sigma, weights, width, largest }) => {
      const kernel = weights
        ? kernelFromWeights(weights)
        : largest
          ? kernelOfWidth(width, largest)
          : gaussianKernel(radius, sigma);
      return { struct: struct('blur', blurParameters(kernel)), deviation: standardDeviation(kernel) };
    },
    regions: ({ map, layer, regions }) => {
      const block = initialBlock(plan);
      try {
        writeRegions(plan, block, map, layer, regions);
      } catch (error) {
        throw new ValueError('regions', error.message);
      }
      return hexadecimal(block);
    },
    cascades: ({ cascades, camera, atlas }) => ({
      views: placeViews(atlas, cascadeViews(cascades, camera)).map(viewed),
      slices: cascadeSlices(cascades).flat().map(Math.fround),
    }),
    pointLight: ({ light, direction, angle, atlas }) => ({
      views: placeViews(atlas, [...pointLightFaces(light), spotView(light, direction, angle)]).map(viewed),
    }),
  };
}

// What differs, as a sentence; nothing if it is the same.
function difference(make, { input, bytes, refused }) {
  let made;
  try {
    made = make(input);
  } catch (error) {
    if (!(error instanceof ValueError)) return `throws another error than one about a value: ${error.stack}`;
    if (refused === undefined) return `refuses what Rust takes: ${error.message}`;
    return error.subject === refused ? '' : `refuses '${error.subject}', Rust '${refused}'`;
  }
  if (refused !== undefined) return `takes what Rust refuses for '${refused}'`;
  const sorted = (value) => JSON.stringify(typeof value === 'object' ? Object.entries(value).sort() : value);
  return sorted(made) === sorted(bytes) ? '' : `makes ${sorted(made)}, Rust ${sorted(bytes)}`;
}

// Blocks with several structs, and what may not be written.
function checkBlock(plan, initial) {
  const faults = [];
  if (hexadecimal(initialBlock(plan)) !== initial) faults.push("the initial block is not Rust's");
  const block = initialBlock(plan);
  const { offset, size, elements } = plan.parameters.blocks.find(({ node }) => node === 'shade');
  const filled = (value) => new Uint8Array(size).fill(value);
  write(plan, block, 'shade', 0, [1, 2, 3].map(filled));
  write(plan, block, 'shade', 0, [4, 5].map(filled));
  const found = Array.from({ length: elements }, (_, element) => block[offset + element * size]);
  if (String(found) !== '4,5,0') faults.push(`of three structs, of which two are given, the first bytes are ${found}`);
  const refusals = [
    ['shadow', 0, {}, "no node with parameters called 'shadow'"],
    ['shade', 1, filled(0), 'layer 1 is none of them'],
    ['shade', 0, [1, 2, 3, 4].map(filled), 'at most 3 structs, 4 were given'],
    ['shade', 0, new Uint8Array(16), `have ${size} bytes, 16 were given`],
    ['resolve', 0, {}, "member 'numerator' (vec2f) is missing"],
    ['resolve', 0, { ...depthConversion({ orthographic: {} }), near: 1 }, "no member 'near'"],
    ['resolve', 0, { ...depthConversion({ orthographic: {} }), scale: '1' }, 'which is no f32'],
    ['resolve', 0, { ...depthConversion({ orthographic: {} }), numerator: [1] }, 'has 1 numbers; it takes 2'],
  ];
  for (const [node, layer, value, words] of refusals) {
    let said = 'nothing';
    try {
      write(plan, block, node, layer, value);
    } catch (error) {
      said = error.message;
    }
    if (!said.includes(words)) faults.push(`it should be refused with the words "${words}"; said is "${said}"`);
  }
  return faults;
}

function main(file) {
  const { plan, initial, cases } = JSON.parse(readFileSync(file, 'utf8'), revive);
  const make = makers(plan);
  const faults = checkBlock(plan, initial);
  const counts = {};
  cases.forEach((given, index) => {
    const found = difference(make[given.kind], given);
    if (found) faults.push(`input ${index}, ${given.kind}: JavaScript ${found}\n${JSON.stringify(given.input)}`);
    const [taken, refused] = counts[given.kind] ?? [0, 0];
    counts[given.kind] = given.refused === undefined ? [taken + 1, refused] : [taken, refused + 1];
  });
  for (const fault of faults) console.error(`${fault}\n`);
  const kinds = Object.entries(counts).map(([kind, [taken, refused]]) => `${kind} ${taken} + ${refused} refused`);
  console.log(`${cases.length} inputs (${kinds.join(', ')}): ${faults.length} differences`);
  // Both ways out have to have been taken by each kind.
  const both = Object.values(counts).every((ways) => Math.min(...ways) > 0);
  if (!both) console.error('some kind of input has nothing that is taken, or nothing that is refused');
  return faults.length === 0 && cases.length >= 1000 && both;
}

if (process.argv.length !== 3) {
  console.error('usage: node parameters.mjs FILE');
  process.exit(2);
}
process.exitCode = main(process.argv[2]) ? 0 : 1;
