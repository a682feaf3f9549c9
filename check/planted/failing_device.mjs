// A device of which one call runs out of memory.

// A device that does what `device` does, but for call number `at` of those that make or write something: it is as if the device had no
// memory for it. `said` has what no error scope caught, `alive` the textures and buffers that were made and not destroyed, and `calls`
// how many calls there were.
export function outOfMemoryAt(device, at) {
  const state = { calls: 0, said: [], alive: new Set() };
  const scopes = [];
  const call = (name) => {
    if (state.calls++ !== at) return false;
    const error = { message: `no memory for ${name}` };
    const scope = scopes.findLast(({ filter }) => filter === 'out-of-memory');
    if (scope) scope.error ??= error;
    else state.said.push(error.message);
    return true;
  };
  const made = {
    pushErrorScope(filter) {
      scopes.push({ filter });
      device.pushErrorScope(filter);
    },
    popErrorScope() {
      const { error } = scopes.pop();
      return device.popErrorScope().then((found) => error ?? found);
    },
    queue: {
      writeBuffer(...written) {
        call('writeBuffer');
        device.queue.writeBuffer(...written);
      },
    },
  };
  const failing = new Proxy(device, {
    get(_, name) {
      if (name in made) return made[name];
      const value = device[name];
      if (typeof value !== 'function') return value;
      return (...described) => {
        const failed = name.startsWith('create') && call(name);
        const object = value.apply(device, described);
        if (failed || (name !== 'createTexture' && name !== 'createBuffer')) return object;
        state.alive.add(object);
        const destroy = object.destroy.bind(object);
        object.destroy = () => {
          state.alive.delete(object);
          destroy();
        };
        return object;
      };
    },
  });
  return [failing, state];
}
