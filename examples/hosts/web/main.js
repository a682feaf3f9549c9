// The page: controls, frames, and what went wrong, in words.

import { openDevice } from './device.js';
import { Orbit } from './orbit.js';
import { fetchPlan } from './plans.js';
import { Renderer } from './renderer.js';

const element = (id) => document.getElementById(id);
const [canvas, trouble, times] = ['picture', 'trouble', 'times'].map(element);
const [technique, storage, sun, split] = ['technique', 'storage', 'sun', 'split'].map(element);

let stopped = false;

// Says what is wrong, or that nothing is.
function say(message) {
  // What has stopped the page stays.
  if (stopped) return;
  trouble.textContent = message;
  trouble.hidden = !message;
}

// Says what went wrong, and draws no further frame.
function stop(message) {
  say(message);
  stopped = true;
}

function fill(select, names) {
  const before = select.value;
  select.replaceChildren(...names.map((name) => new Option(name, name)));
  if (names.includes(before)) select.value = before;
}

// Width and height of the canvas in pixels of the screen, within what the device has.
function pixels(device) {
  const scale = Math.min(devicePixelRatio, 2);
  const side = (length) => Math.min(Math.max(Math.round(length * scale), 1), device.limits.maxTextureDimension2D);
  return [side(canvas.clientWidth), side(canvas.clientHeight)];
}

async function main() {
  const device = await openDevice(stop);
  device.addEventListener('uncapturederror', ({ error }) => stop(`The graphics device objects: ${error.message}`));
  const context = canvas.getContext('webgpu');
  const format = navigator.gpu.getPreferredCanvasFormat();
  context.configure({ device, format });
  const renderer = new Renderer(device, format);
  const orbit = new Orbit(canvas);

  const { plans, reference } = await fetchPlan('index.json');
  const fit = async () => {
    const [width, height] = pixels(device);
    if (String([width, height]) === String(renderer.size)) return;
    [canvas.width, canvas.height] = [width, height];
    await renderer.resize(width, height);
  };
  await fit();
  await renderer.take('reference', await fetchPlan(reference.file), reference.map);

  const storages = () => plans.filter((plan) => plan.technique === technique.value).map((plan) => plan.storage);
  fill(technique, [...new Set(plans.map((plan) => plan.technique))]);
  fill(storage, storages());

  // One change after the other: a plan, or a size.
  let changes = Promise.resolve();
  let waiting = 0;
  const change = (work, onError) => {
    waiting += 1;
    changes = changes.then(work).then(() => say(''), onError).finally(() => (waiting -= 1));
    return changes;
  };
  const choose = () => {
    const chosen = plans.find((plan) => plan.technique === technique.value && plan.storage === storage.value);
    const take = async () => renderer.take('chosen', await fetchPlan(chosen.file), chosen.map);
    // The plan before stays.
    return change(take, (error) => (renderer.chosen ? say : stop)(error.message));
  };
  technique.addEventListener('change', () => {
    fill(storage, storages());
    choose();
  });
  storage.addEventListener('change', choose);
  await choose();
  new ResizeObserver(() => change(fit, (error) => stop(error.message))).observe(canvas);

  const line = element('line');
  const [left, right] = line.children;
  let [measured, since] = [[], 0];
  const frame = async () => {
    if (stopped) return;
    if (waiting === 0) {
      const share = split.value / 100;
      line.hidden = share === 0 || share === 1;
      line.style.left = `${100 * share}%`;
      left.textContent = `${technique.value}, ${storage.value}`;
      right.textContent = reference.technique;
      const start = performance.now();
      const angle = (sun.value * Math.PI) / 180;
      renderer.draw(context.getCurrentTexture().createView(), { eye: orbit.eye, angle, split: share });
      // The next frame waits for this one, so that times are not those of a queue.
      await device.queue.onSubmittedWorkDone();
      measured.push(performance.now() - start);
      if (start - since > 1000) {
        const median = measured.sort((a, b) => a - b)[measured.length >> 1];
        times.textContent = `${median.toFixed(1)} ms a frame, both techniques`;
        [measured, since] = [[], start];
      }
    }
    requestAnimationFrame(() => frame().catch((error) => stop(error.message)));
  };
  await frame();
}

main().catch((error) => stop(error.message));
