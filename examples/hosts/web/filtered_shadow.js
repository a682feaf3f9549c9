// A light's shadow in three.js, filtered by a plan: three.js draws the map, the recorder filters it, and materials look up what came out
// by a function of the library.

import { createRecorder } from 'moment-shadows-graph';
import {
  biasForStoredDepth,
  blurParameters,
  depthConversion,
  depthPerTexel,
  gaussianKernel,
  initialBlock,
  receiverBias,
  standardDeviation,
  write,
} from 'moment-shadows-graph/parameters.js';
import { ExternalTexture, LinearFilter, Matrix4, RenderTarget, Vector3 } from 'three';
import {
  ShadowNode,
  dFdx,
  dFdy,
  lightShadowMatrix,
  positionWorld,
  renderGroup,
  screenUV,
  texture,
  uniform,
  vec2,
  vec3,
  wgsl,
  wgslFn,
} from 'three/tsl';

// The lit share, called by name from what three.js generates.
const LIT = `
fn lit(texel: vec4f, place: vec3f, across: vec3f, down: vec3f, bias: vec3f, step: u32, texels: vec2f) -> f32 {
    if (any(place.xy < vec2f(0.0)) || any(place.xy > texels) || place.z > 1.0) {
        return 1.0;
    }
    return 1.0 - filtered_shadow(texel, place, across, down, ReceiverBias(bias.x, bias.y, bias.z, step));
}`;

// How an orthographic light of three.js stores depth.
const DEPTH = { orthographic: { reversed: false } };

export class FilteredShadow extends ShadowNode {
  /** For a light with parallel rays. `linked` is filtered_shadow.wgsl with all that it imports; `share` of the picture is ours. */
  static async create(renderer, light, plan, linked) {
    const node = new FilteredShadow(light);
    // Made as three.js makes it, before its first frame, since pipelines and textures of the plan take a while.
    const createRenderTarget = (...settings) => new RenderTarget(...settings);
    node.target = node.setupRenderTarget(light.shadow, { renderer, createRenderTarget });
    renderer.initRenderTarget(node.target.shadowMap);
    const depth = renderer.backend.get(node.target.depthTexture).texture;
    const device = renderer.backend.device;
    const recorder = await createRecorder(device, plan, { light_depth: depth });
    const map = new ExternalTexture(recorder.output('shadow_map'));
    map.minFilter = map.magFilter = LinearFilter;
    // Of the render's group: those of an object keep their values until the object changes (findings/three_shadow_uniform.sh).
    const told = { bias: uniform(new Vector3()), step: uniform(0, 'uint'), share: uniform(1) };
    for (const value of Object.values(told)) value.setGroup(renderGroup);
    return Object.assign(node, {
      device,
      recorder,
      map,
      told,
      format: depth.format,
      block: initialBlock(plan),
      lit: wgslFn(LIT, [wgsl(linked)]),
    });
  }

  setupRenderTarget(shadow, builder) {
    return this.target ?? super.setupRenderTarget(shadow, builder);
  }

  /** Draws the map, as ever, and then filters it. */
  renderShadow(frame) {
    super.renderShadow(frame);
    const { plan, parameters } = this.recorder;
    const { camera, mapSize, radius } = this.shadow;
    const weights = gaussianKernel(radius, 0.6 * radius);
    const clipFromWorld = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    const perTexel = depthPerTexel({ clipFromWorld, depth: DEPTH }, mapSize.toArray());
    const conversion = depthConversion(DEPTH);
    const bias = biasForStoredDepth(receiverBias(standardDeviation(weights), perTexel), this.format, conversion);
    this.told.bias.value.set(bias.constant, bias.slope_scale, bias.maximum);
    this.told.step.value = bias.step;
    write(plan, this.block, 'resolve', 0, conversion);
    write(plan, this.block, 'blur', 0, blurParameters(weights));
    this.device.queue.writeBuffer(parameters, 0, this.block);
    const encoder = this.device.createCommandEncoder();
    this.recorder.record('after_shadow_maps', encoder);
    this.device.queue.submit([encoder.finish()]);
  }

  setupShadowFilter(builder, inputs) {
    const theirs = super.setupShadowFilter(builder, inputs);
    // Without the biases of three.js, which stand in its own coordinates.
    const stored = lightShadowMatrix(this.light).mul(positionWorld).xyz;
    const at = vec2(stored.x, stored.y.oneMinus());
    const texels = vec2(...this.shadow.mapSize.toArray());
    const place = vec3(at.mul(texels), stored.z.mul(2).sub(1)).toVar();
    const { bias, step, share } = this.told;
    const texel = texture(this.map, at).level(0);
    const ours = this.lit({ texel, place, across: dFdx(place), down: dFdy(place), bias, step, texels }).toVar();
    return screenUV.x.lessThan(share).select(ours, theirs);
  }
}
