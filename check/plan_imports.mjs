// The imports that a plan describes, made for it.

// Textures and buffers with the usages that passes need and `usage`. A multisampled texture with several layers is a list of textures.
export function makeImports(device, plan, usage = 0) {
  const made = plan.imports.map(({ name, resource }) => {
    const { desc, usage: names } = plan.resources[resource];
    const flags = (all) => names.reduce((bits, name) => bits | all[name], usage);
    if (desc.buffer) return [name, device.createBuffer({ size: desc.buffer.size, usage: flags(GPUBufferUsage) })];
    const { format, size, layers, planes, mips, samples } = desc.texture;
    const texture = (count) =>
      device.createTexture({
        label: name,
        format,
        size: [...size, count],
        mipLevelCount: mips,
        sampleCount: samples,
        usage: flags(GPUTextureUsage),
      });
    const count = layers * planes;
    return [name, samples > 1 && count > 1 ? Array.from({ length: count }, () => texture(1)) : texture(count)];
  });
  return Object.fromEntries(made);
}

// Width and height of the imports as the plan has them, by name.
export function sizesOfPlan(plan) {
  const textures = plan.imports.filter(({ resource }) => plan.resources[resource].desc.texture);
  return Object.fromEntries(textures.map(({ name, resource }) => [name, plan.resources[resource].desc.texture.size]));
}
