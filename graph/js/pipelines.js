// The pipelines of a plan: one per distinct shader, entry point, constants, layout and target. A change of sizes needs no new one.

import { scoped } from './error_scopes.js';

/** For each pass `{ label, pipeline, layout }`; of a host's pass only the label. */
export async function makePipelines(device, plan) {
  const steps = await scoped(device, "the plan's pipelines", () => begin(device, plan));
  return Promise.all(steps.map(async (step) => ({ ...step, pipeline: await step.pipeline })));
}

function begin(device, plan) {
  const modules = plan.shaders.map((code, index) => device.createShaderModule({ label: `moment-shadows/shader ${index}`, code }));
  const [layouts, pipelines] = [new Map(), new Map()];
  const once = (all, key, make) => all.get(key) ?? all.set(key, make()).get(key);
  // Groups below the plan's are the host's; here they are empty.
  const empty = device.createBindGroupLayout({ entries: [] });
  return plan.passes.map((pass) => {
    const label = `moment-shadows/${pass.node}/${pass.label}`;
    if (pass.work.host) return { label };
    // A binding's layout is a GPUBindGroupLayoutEntry but for its number and who sees it.
    const visibility = GPUShaderStage[pass.visibility];
    const entries = pass.bindings.map(({ binding, layout }) => ({ binding, visibility, ...layout }));
    const layout = once(layouts, JSON.stringify(entries), () => device.createBindGroupLayout({ label, entries }));
    const { shader, entry_point: entryPoint, vertex_entry_point: vertex, constants } = pass;
    const target = pass.work.fullscreen && plan.resources[pass.work.fullscreen.target].desc.texture.format;
    const key = JSON.stringify([entries, shader, entryPoint, vertex, constants, target]);
    const pipeline = once(pipelines, key, () => {
      const bindGroupLayouts = [...Array(plan.bind_group).fill(empty), layout];
      const shared = { label, layout: device.createPipelineLayout({ label, bindGroupLayouts }) };
      const stage = { module: modules[shader], entryPoint, constants };
      if (pass.work.compute) return device.createComputePipelineAsync({ ...shared, compute: stage });
      // Three vertices without buffers; the vertex stage takes no constants.
      const fragment = { ...stage, targets: [{ format: target }] };
      return device.createRenderPipelineAsync({ ...shared, vertex: { module: modules[shader], entryPoint: vertex }, fragment });
    });
    // Who waits for it hears of a refusal; nobody does where something else is refused first.
    pipeline.catch(() => {});
    return { label, layout, pipeline };
  });
}
