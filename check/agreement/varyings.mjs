// What stands on the other side of an entry point's inputs and outputs: vertex buffers, targets, a vertex shader.

const kind = (type) => ({ u: 'uint', i: 'sint' })[type.match(/^(?:vec\d)?<?([ui])/)?.[1]] ?? 'float';
const width = (type) => Number(type.match(/^vec(\d)/)?.[1] ?? 1);

// The format of a target for values of `type`.
export function formatOf(type) {
  return ['r8', 'rg8', 'rgba8', 'rgba8'][width(type) - 1] + { uint: 'uint', sint: 'sint', float: 'unorm' }[kind(type)];
}

// Vertex buffers that hold `inputs`.
export function bufferOf(inputs) {
  if (inputs.length === 0) return [];
  const attributes = inputs.map(({ location, type }, index) => ({
    shaderLocation: location,
    offset: 16 * index,
    format: `${kind(type)}32x4`,
  }));
  return [{ arrayStride: 512, attributes }];
}

// A vertex shader that gives a fragment shader its `inputs`.
export function vertexTextFor(inputs) {
  const members = inputs.map(({ location, type, interpolate }, index) => `  @location(${location}) ${interpolate} v${index}: ${type},\n`);
  return `struct Varyings {
  @builtin(position) place: vec4f,
${members.join('')}}
@vertex fn vertex_shader() -> Varyings { var result: Varyings; return result; }`;
}
