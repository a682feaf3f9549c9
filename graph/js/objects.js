// Textures, views and bind groups of a plan.

/** A texture or a buffer of the plan's memory. */
export function allocate(device, { label, desc, usage }) {
  const flags = (names, all) => names.reduce((bits, name) => bits | all[name], 0);
  if (desc.buffer) return device.createBuffer({ label, size: desc.buffer.size, usage: flags(usage, GPUBufferUsage) });
  const { format, size, layers, planes, mips, samples } = desc.texture;
  return device.createTexture({
    label,
    format,
    size: [...size, layers * planes],
    mipLevelCount: mips,
    sampleCount: samples,
    usage: flags(usage, GPUTextureUsage),
  });
}

/** What a pass is recorded with, one per layer: `groups` and `targets`, or of a host's pass `drawn` with its `targets` and `depth`. */
export function bindPass(bound, pass, { label, layout }) {
  const { fullscreen, host } = pass.work;
  const layers = Array.from({ length: pass.layers }, (_, layer) => layer);
  if (host) {
    const planes = Array.from({ length: host.planes ?? 1 }, (_, plane) => plane);
    const drawn = (target, plane, layer) => view(bound, target, { level: 0, plane }, layer, 'all');
    const ofLayer = (layer) => ({
      targets: host.targets.flatMap((target) => planes.map((plane) => drawn(target, plane, layer))),
      depth: host.depth === null ? undefined : drawn(host.depth, 0, layer),
    });
    return { drawn: layers.map(ofLayer) };
  }
  const groups = layers.map((layer) => {
    const entries = pass.bindings.map((planned) => ({ binding: planned.binding, resource: held(bound, planned, layer) }));
    return bound.device.createBindGroup({ label, layout, entries });
  });
  return { groups, targets: fullscreen ? layers.map((layer) => view(bound, fullscreen.target, fullscreen.part, layer, 'all')) : [] };
}

// What a binding holds in the pass for a layer.
function held(bound, { layout, resource }, layer) {
  const { texture, storage_texture: written, buffer, sampler } = resource;
  if (sampler) return bound.device.createSampler(sampler);
  if (buffer) return { buffer: bound.object(buffer.resource) };
  if (texture) return view(bound, texture.resource, texture.part, layer);
  if (written) return view(bound, written.resource, written.part, layer);
  // Parameters and regions: where they begin is said by dynamic offsets.
  return { buffer: bound.parameters, size: layout.buffer.minBindingSize };
}

// A view of one mip level of one plane of the layer, or, without a part, an array of all.
function view({ plan, object }, index, part, layer, aspect) {
  const { name, desc } = plan.resources[index];
  const given = object(index);
  const textureLayer = part ? layer * desc.texture.planes + part.plane : 0;
  // Of a list of textures each is one layer.
  const [texture, baseArrayLayer] = Array.isArray(given) ? [given[textureLayer], 0] : [given, textureLayer];
  const isDepth = desc.texture.format.startsWith('depth');
  // A stencil beside the depth is nothing that a shader reads with it.
  const shared = { label: name, aspect: aspect ?? (isDepth ? 'depth-only' : 'all') };
  if (!part) return texture.createView({ ...shared, dimension: '2d-array' });
  return texture.createView({ ...shared, dimension: '2d', baseArrayLayer, arrayLayerCount: 1, baseMipLevel: part.level, mipLevelCount: 1 });
}
