// The ways to make a pipeline of an entry point.

// Attributes 0 to 7 of any vertex shader of ours: it takes of each as many components as it declares.
const BUFFERS = [
  {
    arrayStride: 128,
    attributes: Array.from({ length: 8 }, (_, index) => ({ shaderLocation: index, offset: 16 * index, format: 'float32x4' })),
  },
];

// A vertex shader for a fragment shader that takes nothing but its position.
const FULLSCREEN = `
@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}`;

const DEPTH = { format: 'depth32float', depthWriteEnabled: true, depthCompare: 'less' };

// One of the ways has to do. An entry point has a name, a stage and, in a fragment shader, the formats of its targets. It
// may have as well: `buffers` of a vertex shader, `vertexText`, the vertex shader that a fragment shader goes with, and
// `depth`, whether a fragment shader writes it. A fragment shader without a `vertexText` fits one of the vertex shaders
// among `entryPoints`.
export function pipelines(device, module, entryPoint, entryPoints, constants = {}) {
  const { name, stage, targets = [], buffers = BUFFERS, vertexText, depth } = entryPoint;
  const layout = 'auto';
  if (stage === 'compute') {
    return [() => device.createComputePipelineAsync({ layout, compute: { module, entryPoint: name, constants } })];
  }
  const vertexStage = ({ name, buffers = BUFFERS }) => ({ module, entryPoint: name, constants, buffers });
  if (stage === 'vertex') {
    return [() => device.createRenderPipelineAsync({ layout, vertex: vertexStage({ name, buffers }), depthStencil: DEPTH })];
  }
  const fragment = { module, entryPoint: name, constants, targets: targets.map((format) => format && { format }) };
  const vertices = vertexText ? [] : entryPoints.filter(({ stage }) => stage === 'vertex').map(vertexStage);
  if (vertices.length === 0) vertices.push({ module: device.createShaderModule({ code: vertexText ?? FULLSCREEN }) });
  const depthStencil = depth || !targets.some(Boolean) ? DEPTH : undefined;
  return vertices.map((vertex) => () => device.createRenderPipelineAsync({ layout, vertex, fragment, depthStencil }));
}
