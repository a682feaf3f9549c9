// A small renderer: the sun's depth, the camera's depth, shadows and air, and a picture lit with them.

import { Air } from './air.js';
import { SHADER, STRIDE, vertices } from './scene.js';
import { Shadows } from './shadows.js';
import { view } from './view.js';

const MAP = 1024;
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
    this.groups = [[uniform], [uniform, texture(1), texture(2), texture(3)]].map((entries) => device.createBindGroupLayout({ entries }));
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
    // What has been drawn to the depth before, and where there is nothing.
    const seen = (vertex, entryPoint, cullMode) =>
      device.createRenderPipeline({
        layout: layout(this.groups[1]),
        vertex,
        primitive: { cullMode },
        fragment: { module, entryPoint, targets: [{ format }] },
        depthStencil: { format: 'depth32float', depthWriteEnabled: false, depthCompare: 'equal' },
      });
    this.pipelines = {
      sun: { 1: depthOnly('less', 1), 4: depthOnly('less', 4) },
      camera: depthOnly('greater', 1),
      picture: seen(vertex('place', 3), 'light', 'back'),
      sky: seen({ module, entryPoint: 'cover' }, 'sky', 'none'),
    };
    const uniforms = () => device.createBuffer({ size: 80, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    this.uniforms = { sun: uniforms(), camera: uniforms() };
    // Filterable maps are made of several samples per texel, what compares with the plain map has one.
    const map = (sampleCount) => device.createTexture({ size: [MAP, MAP], format: 'depth32float', sampleCount, usage: DRAWN });
    this.maps = { 1: map(1), 4: map(4) };
    this.noAir = device.createTexture({
      size: [1, 1],
      format: 'rgba8unorm',
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    device.queue.writeTexture({ texture: this.noAir }, new Uint8Array([0, 0, 0, 255]), {}, [1, 1]);
  }

  /** Takes a size of the picture. */
  async resize(width, height) {
    const before = this.cameraDepth;
    this.cameraDepth = this.device.createTexture({ size: [width, height], format: 'depth32float', usage: DRAWN });
    this.size = [width, height];
    const plans = ['chosen', 'reference', 'air'].flatMap((which) => this[which] ?? []);
    await Promise.all(plans.map((plan) => plan.resize(this.imports(plan))));
    before?.destroy();
  }

  imports({ samples }) {
    return { light_depth: this.maps[samples], camera_depth: this.cameraDepth };
  }

  /** Takes a plan as the `chosen` one, the `reference` or the `air`. Of shadows `map` is the resource that is looked up. */
  async take(which, plan, more) {
    const { samples } = plan.resources.find(({ name }) => name === 'light_depth').desc.texture;
    const kind = which === 'air' ? Air : Shadows;
    const taken = await kind.create(this.device, plan, this.imports({ samples }), { samples, ...more });
    this[which]?.destroy();
    this[which] = taken;
  }

  /** What is seen, from left to right. Before there is something to compare with, that is the chosen technique. */
  shown(split) {
    const shown = [split > 0 && this.chosen, split < 1 && this.reference].filter(Boolean);
    return shown.length > 0 ? shown : [this.chosen];
  }

  /**
   * Draws a frame. `split` is the share of the picture that shows the chosen technique; one that is not seen is not recorded. `air` is left
   * out where it is clear.
   */
  draw(target, { eye, angle, split, size, air }) {
    const [width] = this.size;
    const { towardsSun, sun, camera } = view({ eye, angle, size: this.size });
    const uniform = (buffer, matrix) => {
      this.device.queue.writeBuffer(buffer, 0, new Float32Array([...matrix, ...towardsSun, Math.round(split * width)]));
    };
    uniform(this.uniforms.sun, sun);
    uniform(this.uniforms.camera, camera.clipFromWorld);
    const shadows = this.shown(split);
    for (const plan of shadows) plan.look(camera, sun, size);
    if (air) this.air.look(camera, sun, air);
    const plans = air ? [...shadows, this.air] : shadows;

    const encoder = this.device.createCommandEncoder();
    for (const samples of new Set(plans.map((plan) => plan.samples))) {
      this.drawDepth(encoder, this.pipelines.sun[samples], this.uniforms.sun, this.maps[samples], 1);
    }
    for (const plan of plans) plan.record('after_shadow_maps', encoder);
    this.drawDepth(encoder, this.pipelines.camera, this.uniforms.camera, this.cameraDepth, 0);
    for (const plan of plans) plan.record('after_main_pass', encoder);
    this.drawPicture(encoder, target, [shadows[0].intensity, shadows.at(-1).intensity, air ? this.air.scattering : this.noAir]);
    this.device.queue.submit([encoder.finish()]);
  }

  drawDepth(encoder, pipeline, uniforms, texture, depthClearValue) {
    const attachment = { view: texture.createView(), depthClearValue, depthLoadOp: 'clear', depthStoreOp: 'store' };
    const pass = encoder.beginRenderPass({ colorAttachments: [], depthStencilAttachment: attachment });
    this.drawScene(pass, pipeline, this.group(0, uniforms, []));
    pass.end();
  }

  drawPicture(encoder, view, textures) {
    const pass = encoder.beginRenderPass({
      colorAttachments: [{ view, loadOp: 'clear', storeOp: 'store' }],
      depthStencilAttachment: { view: this.cameraDepth.createView(), depthLoadOp: 'load', depthStoreOp: 'store' },
    });
    this.drawScene(pass, this.pipelines.picture, this.group(1, this.uniforms.camera, textures));
    pass.setPipeline(this.pipelines.sky);
    pass.draw(3);
    pass.end();
  }

  group(layout, buffer, textures) {
    const resources = [{ buffer }, ...textures.map((texture) => texture.createView())];
    const entries = resources.map((resource, binding) => ({ binding, resource }));
    return this.device.createBindGroup({ layout: this.groups[layout], entries });
  }

  drawScene(pass, pipeline, group) {
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.setVertexBuffer(0, this.vertices);
    pass.draw(this.count);
  }
}
