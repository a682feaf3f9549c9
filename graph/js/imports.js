// What a host gives: a texture, a list of textures (one per layer, for multisampled ones with several), or a buffer.

/** The imports of a plan in its order, each checked against its description but for width and height. */
export function checkImports(plan, given) {
  return plan.imports.map(({ name, resource }) => {
    const { desc, usage } = plan.resources[resource];
    const wrong = difference(desc, usage, given[name]);
    if (!wrong) return given[name];
    throw new Error(`import '${name}' ${wrong}; the plan was compiled for ${described(desc)}`);
  });
}

/** Width and height of each import that is a texture, by name. */
export function sizesOf(plan, given) {
  const textures = plan.imports.filter(({ resource }) => plan.resources[resource].desc.texture);
  return Object.fromEntries(
    textures.map(({ name }) => {
      const { width, height } = [given[name]].flat()[0];
      return [name, [width, height]];
    }),
  );
}

function difference(desc, usage, given) {
  if (!given) return 'is missing';
  if (desc.buffer) {
    const fits = given.size >= desc.buffer.size && given.usage & GPUBufferUsage.STORAGE;
    return fits ? '' : `is no buffer of ${desc.buffer.size} bytes with the usage STORAGE`;
  }
  const { format, layers, planes, mips, samples } = desc.texture;
  const [textures, listed] = [[given].flat(), Array.isArray(given)];
  if (listed && textures.length !== layers * planes) return `is a list of ${textures.length} textures`;
  for (const texture of textures) {
    const each = [texture.format, texture.depthOrArrayLayers, texture.mipLevelCount, texture.sampleCount];
    const expected = [format, listed ? 1 : layers * planes, mips, samples];
    const named = ['the format', 'array layers:', 'mip levels:', 'samples:'];
    const wrong = expected.findIndex((value, index) => value !== each[index]);
    if (wrong >= 0) return `has ${named[wrong]} ${each[wrong]}, not ${expected[wrong]}`;
    if (texture.width !== textures[0].width || texture.height !== textures[0].height) return 'is a list of textures of several sizes';
    const missing = usage.filter((name) => !(texture.usage & GPUTextureUsage[name]));
    if (missing.length > 0) return `lacks the usage ${missing.join(', ')}`;
  }
  return '';
}

function described({ texture, buffer }) {
  if (buffer) return `a buffer of ${buffer.size} bytes`;
  const { format, size, layers, planes, mips, samples } = texture;
  return `${format} ${size[0]}x${size[1]}, array layers: ${layers * planes}, mip levels: ${mips}, samples: ${samples}`;
}
