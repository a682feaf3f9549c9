// Which layers a pass is recorded for, and whether the plan has what is asked for.

/** The layers to record. A pass that follows no single layer is recorded whole, whatever changed. */
export function dirtyLayers(pass, layers) {
  if (!layers || !pass.each_layer) return Array.from({ length: pass.layers }, (_, layer) => layer);
  return Array.isArray(layers) ? layers : (layers[pass.map] ?? []);
}

/** Throws an Error where a recording asks for what there is not. */
export function checkRecording({ device, plan, parameters }, stage, { offset, layers, hostPass }) {
  if (!['after_shadow_maps', 'after_main_pass'].includes(stage)) {
    throw new Error(`there is no stage '${stage}'; stages are after_shadow_maps and after_main_pass`);
  }
  const alignment = device.limits.minUniformBufferOffsetAlignment;
  const needed = plan.parameters.size;
  if (parameters && !(offset % alignment === 0 && offset >= 0 && offset + needed <= parameters.size)) {
    const legal = `offsets are multiples of ${alignment}, and ${needed} bytes have to follow in a buffer of ${parameters.size}`;
    throw new Error(`a view's parameters cannot begin at byte ${offset}: ${legal}`);
  }
  const maps = [...new Set(plan.passes.map(({ map }) => map))];
  const unknown = layers && !Array.isArray(layers) ? Object.keys(layers).find((map) => !maps.includes(map)) : undefined;
  if (unknown !== undefined) throw new Error(`no pass follows a map '${unknown}'; dirty layers are those of: ${maps.join(', ')}`);
  for (const pass of plan.passes.filter((pass) => pass.stage === stage)) {
    const name = `${pass.node}/${pass.label}`;
    if (pass.work.host && !hostPass) throw new Error(`stage '${stage}' has the host's pass '${name}'; give hostPass, which draws it`);
    const absent = dirtyLayers(pass, layers).find((layer) => !(Number.isInteger(layer) && layer >= 0 && layer < pass.layers));
    if (absent !== undefined) throw new Error(`layer ${absent} is marked dirty, but pass '${name}' has ${pass.layers} layers`);
  }
}
