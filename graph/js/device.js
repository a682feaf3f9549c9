// Whether a device can run a plan.

/** The version of the plans that this package records. */
export const VERSION = 3;

/** Throws an Error that says what to request, where the device lacks what the plan needs. */
export function checkDevice(device, plan) {
  if (plan.version !== VERSION) {
    throw new Error(`the plan has version ${plan.version}, this recorder reads version ${VERSION}; export the plan with the same release`);
  }
  const { features, wgpu_features: native, limits } = plan.device;
  if (native.length > 0) {
    const profile = 'compile the graph for the profile webgpu-core';
    throw new Error(`the plan needs ${native.join(', ')}, which no browser has; ${profile}`);
  }
  const missing = features.filter((feature) => !device.features.has(feature));
  if (missing.length > 0) {
    const names = missing.map((feature) => `'${feature}'`).join(', ');
    throw new Error(`the device lacks the feature ${names}; request it with requiredFeatures: [${names}], or compile the graph without`);
  }
  for (const [name, needed] of Object.entries(limits)) {
    const offered = device.limits[name];
    if (name.startsWith('min') ? offered > needed : offered < needed) {
      const request = `request the device with requiredLimits: { ${name}: ${needed} } where the adapter has it`;
      throw new Error(`the plan needs ${needed} as the limit ${name}, the device has ${offered}; ${request}`);
    }
  }
}
