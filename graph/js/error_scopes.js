// What a device objects to, said where it happens.

/** Runs `make`, which creates objects without waiting, and gives its result; throws an Error where the device objects. */
export async function scoped(device, what, make) {
  const scopes = ['validation', 'out-of-memory'];
  for (const scope of scopes) device.pushErrorScope(scope);
  let errors;
  try {
    const made = make();
    errors = scopes.map(() => device.popErrorScope());
    const error = (await Promise.all(errors)).find(Boolean);
    if (!error) return made;
    made?.destroy?.();
    throw new Error(`${what} cannot be made: ${error.message}`);
  } finally {
    if (!errors) await Promise.all(scopes.map(() => device.popErrorScope()));
  }
}
