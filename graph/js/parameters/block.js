// The block of a view: all uniform data that a plan's passes read for it. A host keeps one block per view in a buffer.

import { isWhole, overlap } from './map_region.js';
import { structBytes } from './struct.js';

/** A view's block with every node's initial values. */
export function initialBlock(plan) {
  const block = new Uint8Array(plan.parameters.size);
  for (const planned of plan.parameters.blocks) {
    for (let layer = 0; layer < planned.count; layer++) reset(block, planned, layer, 0);
  }
  for (const table of plan.parameters.regions) {
    for (let layer = 0; layer < table.layers; layer++) block.set(table.initial, table.offset + layer * table.stride);
  }
  return block;
}

/**
 * Writes a node's struct (for `layer`, where there is one per layer) into a view's block: an object with its members, its bytes, or an
 * array of such where the node has several. Those that are not given become what they were at the beginning.
 */
export function write(plan, block, node, layer, values) {
  const planned = named(plan.parameters.blocks, 'node', node, 'node with parameters');
  const { name, size, elements, count, fields } = planned;
  const structs = Array.isArray(values) ? values : [values];
  const of = `node '${node}'`;
  if (structs.length > elements) {
    throw new Error(`${of}: its parameters (${name}) are at most ${elements} structs, ${structs.length} were given`);
  }
  if (!(Number.isInteger(layer) && layer >= 0 && layer < count)) {
    throw new Error(`${of}: it has parameters for ${count} layers; layer ${layer} is none of them`);
  }
  const bytes = structs.map((value) => {
    if (!ArrayBuffer.isView(value)) {
      try {
        return structBytes(size, fields, value);
      } catch (error) {
        throw new Error(`${of}: its parameters (${name}): ${error.message}`);
      }
    }
    if (value.byteLength === size) return new Uint8Array(value.buffer, value.byteOffset, size);
    throw new Error(`${of}: its parameters (${name}) have ${size} bytes, ${value.byteLength} were given`);
  });
  checkLength(plan, block);
  bytes.forEach((struct, element) => block.set(struct, start(planned, layer, element)));
  reset(block, planned, layer, structs.length);
}

/**
 * Writes the regions of a map's layer into a view's block. Texels outside of them keep their contents, so a host lists those that
 * have changed. The map is named as the import is (or `node.slot`, where a node makes a map of its own).
 */
export function writeRegions(plan, block, map, layer, regions) {
  const table = named(plan.parameters.regions, 'map', map, 'map with regions');
  if (!(Number.isInteger(layer) && layer >= 0 && layer < table.layers)) {
    throw new Error(`map '${map}' has ${table.layers} layers; layer ${layer} is none of them`);
  }
  checkRegions(table, regions);
  checkLength(plan, block);
  const words = new DataView(block.buffer, block.byteOffset + table.offset + layer * table.stride, 16 * table.capacity);
  for (let word = 0; word < 4 * table.capacity; word++) words.setUint32(4 * word, 0);
  regions.forEach(({ origin, extent }, index) => {
    [...origin, ...extent].forEach((texels, word) => words.setUint32(16 * index + 4 * word, texels, true));
  });
}

function checkRegions({ map, capacity, extent: [width, height], smallest }, regions) {
  if (regions.length > capacity) {
    const count = regions.length;
    const next = `describe the import with 'regions': ${count}`;
    throw new Error(`a layer of map '${map}' has at most ${capacity} regions, ${count} were given; ${next}`);
  }
  regions.forEach((region, index) => {
    const { origin, extent } = region;
    const texels = [...origin, ...extent];
    if (texels.length !== 4 || texels.some((value) => value !== value >>> 0)) {
      throw new Error(`region ${index} of map '${map}' is ${texels}; an origin and an extent are two whole numbers of texels each`);
    }
    const inside = origin[0] + extent[0] <= width && origin[1] + extent[1] <= height;
    if (!isWhole(region) && !inside) {
      const runs = `runs from ${origin[0]}, ${origin[1]} on over ${extent[0]} x ${extent[1]} texels`;
      throw new Error(`region ${index} of map '${map}' ${runs}; the map has ${width} x ${height}`);
    }
    if (!isWhole(region) && Math.min(...extent) < smallest) {
      const fewest = `${smallest} along each side are the fewest that the graph's filter can work on`;
      throw new Error(`region ${index} of map '${map}' has ${extent[0]} x ${extent[1]} texels; ${fewest}`);
    }
    const first = regions.slice(0, index).findIndex((earlier) => overlap(earlier, region));
    if (first >= 0) throw new Error(`regions ${first} and ${index} of map '${map}' overlap; each texel belongs to one region`);
  });
}

const start = ({ offset, stride, size }, layer, element) => offset + layer * stride + element * size;

function reset(block, planned, layer, first) {
  for (let element = first; element < planned.elements; element++) {
    const at = start(planned, layer, element);
    block.fill(0, at, at + planned.size);
    block.set(planned.initial, at);
  }
}

function named(all, key, name, what) {
  const found = all.find((entry) => entry[key] === name);
  if (found) return found;
  throw new Error(`there is no ${what} called '${name}' in this plan; there are: ${all.map((entry) => entry[key]).join(', ') || 'none'}`);
}

function checkLength(plan, block) {
  const needed = plan.parameters.size;
  if (block.byteLength < needed) throw new Error(`a view's block has ${needed} bytes, ${block.byteLength} were given`);
}
