// The device, or why there is none.

/** Opens a device with what every browser offers. `lost` is told, in words, when it is gone or objects. */
export async function openDevice(lost) {
  if (!navigator.gpu) {
    const secure = isSecureContext ? '' : ' Pages get it over https or from localhost only.';
    throw new Error(`This browser has no WebGPU.${secure} Chrome, Edge, Safari 26 and Firefox on Windows and macOS have it.`);
  }
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) throw new Error('This browser has WebGPU, but finds no graphics adapter for it; a driver may be missing, or blocked.');
  const device = await adapter.requestDevice();
  device.lost.then(({ reason, message }) => lost(`The graphics device was lost: ${message || reason} Reload the page to go on.`));
  device.addEventListener('uncapturederror', ({ error }) => lost(`The graphics device objects: ${error.message}`));
  return device;
}
