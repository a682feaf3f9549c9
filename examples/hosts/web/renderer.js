// A small renderer: the sun's depth, the camera's depth, shadows, and a picture lit with them.

import { parallel, perspective } from './matrix.js';
import { SHADER, STRIDE, vertices } from './scene.js';
import { Shadows } from './shadows.js';

const MAP = 1024;
const REACH = 10;
const DRAWN = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING;

export class Renderer {
  constructor(device, format) {
    this.device = device;
    const corners = vertices();
    this.count = (4 * corners.length) / STRIDE;
    this.vertices = device.createBuffer({ size: corners.byteLength, usage: GPUBufferUsage.VERTEX | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(this.vertices, 0, corners);

    const module = device.createShaderModule({ code: SHADER });
    const uniform = { binding: 0, visibility: GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT, buffer: {} };
    const texture = (binding) => ({ binding, visibility: GPUShaderStage.FRAGMENT, texture: {} });
    this.groups = [[uniform], [uniform, texture(1), texture(2)]].map((entries) => device.createBindGroupLayout({ entries }));
    const layout = (group) => device.createPipelineLayout({ bindGroupLayouts: [group] });
    const attribute = (shaderLocation) => ({ shaderLocation, offset: 12 * shaderLocation, format: 'float32x3' });
    const vertex = (entryPoint, count) => {
      const attributes = [0, 1, 2].slice(0, count).map(attribute);
      return { module, entryPoint, buffers: [{ arrayStride: STRIDE, attributes }] };
    };
    const depthOnly = (depthCompare, samples) =>
      device.createRenderPipeline({
        layout: layout(this.groups[0]),
        vertex: vertex('depth', 1),
        primitive: { cullMode: 'back' },
        multisample: { count: samples },
        depthStencil: { format: 'depth32float', depthWriteEnabled: true, depthCompare },
      });
    this.pipelines = {
      sun: { 1: depthOnly('less', 1), 4: depthOnly('less', 4) },
      camera: depthOnly('greater', 1),
      picture: device.createRenderPipeline({
        layout: layout(this.groups[1]),
        vertex: vertex('place', 3),
        primitive: { cullMode: 'back' },
        fragment: { module, entryPoint: 'light', targets: [{ format }] },
        depthStencil: { format: 'depth32float', depthWriteEnabled: false, depthCompare: 'equal' },
      }),
    };
    const uniforms = () => device.createBuffer({ size: 80, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    this.uniforms = { sun: uniforms(), camera: uniforms() };
    // Filterable maps are made of several samples per texel, what compares with the plain map has one.
    const map = (sampleCount) => device.createTexture({ size: [MAP, MAP], format: 'depth32float', sampleCount, usage: DRAWN });
    this.maps = { 1: map(1), 4: map(4) };
  }

  /** Takes a size of the picture. */
  async resize(width, height) {
    const before = this.cameraDepth;
    this.cameraDepth = this.device.createTexture({ size: [width, height], format: 'depth32float', usage: DRAWN });
    this.size = [width, height];
    await Promise.all(['chosen', 'reference'].filter((which) => this[which]).map((which) => this[which].resize(this.imports(this[which]))));
    before?.destroy();
  }

  imports({ samples }) {
    return { light_depth: this.maps[samples], camera_depth: this.cameraDepth };
  }

  /** Takes a plan as the `chosen` one or the `reference`. */
  async take(which, plan, map) {
    const { samples } = plan.resources.find(({ name }) => name === 'light_depth').desc.texture;
    const shadows = await Shadows.create(this.device, plan, map, this.imports({ samples }));
    this[which]?.destroy();
    this[which] = Object.assign(shadows, { samples });
  }

  /** Draws a frame. `split` is the share of the picture that shows the chosen technique. */
  draw(view, { eye, angle, split }) {
    const [width, height] = this.size;
    const towards = [Math.sin(angle), 1.1, Math.cos(angle)];
    const length = Math.hypot(...towards);
    const sun = parallel(towards, REACH);
    const camera = { clipFromWorld: perspective(eye, [0, 1, 0], { aspect: width / height }), farDepth: 0 };
    const uniform = (buffer, matrix) => {
      const values = [...matrix, ...towards.map((value) => value / length), Math.round(split * width)];
      this.device.queue.writeBuffer(buffer, 0, new Float32Array(values));
    };
    uniform(this.uniforms.sun, sun);
    uniform(this.uniforms.camera, camera.clipFromWorld);
    const both = [this.chosen, this.reference];
    for (const shadows of both) shadows.look(camera, sun);

    const encoder = this.device.createCommandEncoder();
    for (const samples of new Set(both.map((shadows) => shadows.samples))) {
      this.drawDepth(encoder, this.pipelines.sun[samples], this.uniforms.sun, this.maps[samples], 1);
    }
    for (const shadows of both) shadows.record('after_shadow_maps', encoder);
    this.drawDepth(encoder, this.pipelines.camera, this.uniforms.camera, this.cameraDepth, 0);
    for (const shadows of both) shadows.record('after_main_pass', encoder);
    this.drawPicture(encoder, view, both);
    this.device.queue.submit([encoder.finish()]);
  }

  drawDepth(encoder, pipeline, uniforms, texture, depthClearValue) {
    const attachment = { view: texture.createView(), depthClearValue, depthLoadOp: 'clear', depthStoreOp: 'store' };
    const pass = encoder.beginRenderPass({ colorAttachments: [], depthStencilAttachment: attachment });
    this.drawScene(pass, pipeline, this.groups[0], [{ buffer: uniforms }]);
  }

  drawPicture(encoder, view, both) {
    const sky = { r: 0.55, g: 0.65, b: 0.8, a: 1 };
    const pass = encoder.beginRenderPass({
      colorAttachments: [{ view, clearValue: sky, loadOp: 'clear', storeOp: 'store' }],
      depthStencilAttachment: { view: this.cameraDepth.createView(), depthLoadOp: 'load', depthStoreOp: 'store' },
    });
    const shadows = both.map(({ intensity }) => intensity.createView());
    this.drawScene(pass, this.pipelines.picture, this.groups[1], [{ buffer: this.uniforms.camera }, ...shadows]);
  }

  drawScene(pass, pipeline, layout, resources) {
    const entries = resources.map((resource, binding) => ({ binding, resource }));
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.device.createBindGroup({ layout, entries }));
    pass.setVertexBuffer(0, this.vertices);
    pass.draw(this.count);
    pass.end();
  }
}
