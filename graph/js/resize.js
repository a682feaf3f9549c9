// A plan for imports of other sizes, without the compiler: textures, workgroups and regions follow, shaders and layouts stay.

/**
 * The plan for imports with these widths and heights, `{ name: [width, height] }`. Throws an Error where the plan cannot have them: the
 * graph is then to be compiled for them. `most` is the device's limit maxComputeWorkgroupsPerDimension.
 */
export function resized(plan, sizes, most = 65535) {
  const given = plan.imports.map(({ name, resource }) => sizes[name] ?? plan.resources[resource].desc.texture?.size);
  const resources = plan.resources.map((resource) => {
    const { extent, desc } = resource;
    if (!desc.texture) return resource;
    const size = extent ? extent.per.map((texels, axis) => Math.ceil(given[extent.import][axis] / texels)) : desc.texture.size;
    if (resource.home.import !== undefined && !equal(size, given[resource.home.import])) {
      throw new Error(`import '${resource.name}' has ${text(given[resource.home.import])} texels; this plan wants ${text(size)}`);
    }
    checkLevels(resource, size);
    return { ...resource, desc: { texture: { ...desc.texture, size } } };
  });
  checkRanges(resources);
  const memory = plan.memory.map((planned, index) => {
    const resident = resources.find(({ home }) => home.memory === index);
    if (!planned.desc.texture || !resident) return planned;
    return { ...planned, desc: { texture: { ...planned.desc.texture, size: resident.desc.texture.size } } };
  });
  const passes = plan.passes.map((pass) => {
    const { compute } = pass.work;
    if (!compute) return pass;
    const { covers, level, texels_per_workgroup: tile, regions = 1 } = compute;
    const workgroups = workgroupsFor(at(resources[covers].desc.texture.size, level), regions, tile, most);
    return { ...pass, work: { compute: { ...compute, workgroups } } };
  });
  const regions = plan.parameters.regions.map((table) => {
    const map = resources.find(({ name }) => name === table.map);
    const extent = map?.desc.texture?.size ?? table.extent;
    if (Math.min(...extent) < table.smallest) {
      const fewest = `${table.smallest} along each side are the fewest that the graph's filter can work on`;
      throw new Error(`map '${table.map}' would have ${text(extent)} texels; ${fewest}`);
    }
    return { ...table, extent };
  });
  const textures = resources.flatMap(({ desc }) => desc.texture?.size ?? []);
  const workgroups = passes.flatMap(({ work }) => work.compute?.workgroups ?? []);
  const limits = { ...plan.device.limits };
  if (textures.length > 0) limits.maxTextureDimension2D = Math.max(...textures);
  if (workgroups.length > 0) limits.maxComputeWorkgroupsPerDimension = Math.max(...workgroups);
  return { ...plan, device: { ...plan.device, limits }, resources, memory, passes, parameters: { ...plan.parameters, regions } };
}

/**
 * Workgroups in x and y that cover a map of `size` texels, or any of its regions that do not overlap.
 *
 * One region is at most as large as the map and gets a grid. Several with sides w and h take at most the sum of
 * (w + t - 1) (h + u - 1) / (t u) workgroups of t x u texels, whose areas w h sum up to that of the map. Of the sums of the sides, the
 * sum of (u - 1) w + (t - 1) h is largest for strips as long as the map, where it stays below (regions + 1) times the larger of
 * (u - 1) width and (t - 1) height. They are numbered through, in rows of equal length.
 */
export function workgroupsFor([width, height], regions, [across, down], most) {
  const grid = [Math.ceil(width / across), Math.ceil(height / down)];
  if (regions <= 1) return grid;
  const strips = Math.max((down - 1) * width, (across - 1) * height);
  const texels = width * height + (regions + 1) * strips + regions * (across - 1) * (down - 1);
  const eachWhole = regions * grid[0] * grid[1];
  const count = Math.max(Math.min(Math.floor(texels / (across * down)), eachWhole), 1);
  const rows = Math.ceil(count / most);
  return [Math.ceil(count / rows), rows];
}

/** Width and height of a mip level. */
const at = (size, level) => size.map((side) => Math.max(side >>> level, 1));
const equal = (a, b) => a.every((side, axis) => side === b[axis]);
const text = ([width, height]) => `${width}x${height}`;

function checkLevels({ name, home, desc: { texture } }, size) {
  // The levels of a map have at least a texel along its shorter side.
  const side = home.import === undefined ? Math.min(...size) : Math.max(...size);
  const levels = side > 0 ? Math.floor(Math.log2(side)) + 1 : 0;
  if (texture.mips <= levels) return;
  throw new Error(`'${name}' has ${texture.mips} mip levels; ${text(size)} texels have ${levels}, so compile the graph for this size`);
}

// Of a map whose ranges fit themselves each region needs a tile of texels, which looks for its casters.
function checkRanges(resources) {
  for (const { name, desc } of resources) {
    if (desc.texture?.range !== name) continue;
    const node = name.split('.')[0];
    const ends = resources.find((other) => other.name === `${node}.ends`)?.desc.texture.size;
    const [regions] = desc.texture.size;
    if (!ends || ends[0] * ends[1] >= regions) continue;
    throw new Error(`node '${node}' fits ranges of ${regions} regions, more than the ${text(ends)} tiles of its depth map; give it more texels`);
  }
}
