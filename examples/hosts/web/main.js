// The page of techniques: what its controls do to the picture.

import { openDevice } from './device.js';
import { Orbit } from './orbit.js';
import { Page, element } from './page.js';
import { fetchPlan } from './plans.js';
import { Renderer } from './renderer.js';

const page = new Page();
const [technique, storage, radius, size] = ['technique', 'storage', 'radius', 'size'].map(element);
const [angle, split, fog, density, anisotropy] = ['angle', 'split', 'fog', 'density', 'anisotropy'].map(element);

const radians = (degrees) => (degrees * Math.PI) / 180;

function fill(select, names) {
  const before = select.value;
  select.replaceChildren(...names.map((name) => new Option(name, name)));
  if (names.includes(before)) select.value = before;
}

async function main() {
  const device = await openDevice((message) => page.stop(message));
  const context = page.picture.getContext('webgpu');
  const format = navigator.gpu.getPreferredCanvasFormat();
  context.configure({ device, format });
  const renderer = new Renderer(device, format);
  const orbit = new Orbit(page.picture);
  const { plans, references } = await fetchPlan('index.json');
  await page.fit(device, (width, height) => {
    Object.assign(page.picture, { width, height });
    return renderer.resize(width, height);
  });

  // What was there before stays where a plan cannot be had, if anything was.
  const take = (which, file, map) => {
    const fetched = fetchPlan(file);
    // Whoever takes it hears of what went wrong.
    fetched.catch(() => {});
    const failed = (error) => (renderer[which] ? page.say(error.message) : page.stop(error.message));
    return page.change(async () => renderer.take(which, await fetched, map), failed);
  };
  const compare = () => take('reference', references[radius.value], 'light_depth');
  const choose = () => {
    const chosen = plans.find((plan) => plan.technique === technique.value && plan.storage === storage.value);
    // The sun's size makes soft shadows, the width of the blur all others.
    const isSoft = chosen.map.endsWith('.table');
    element('blurred').hidden = isSoft;
    element('sized').hidden = !isSoft;
    return take('chosen', chosen.file, chosen.map);
  };
  const storages = () => plans.filter((plan) => plan.technique === technique.value).map((plan) => plan.storage);
  const breathe = async () => {
    element('air').disabled = !fog.checked;
    if (!fog.checked || renderer.air) return;
    await take('air', 'air.json');
    fog.checked = Boolean(renderer.air);
    element('air').disabled = !fog.checked;
  };

  fill(technique, [...new Set(plans.map((plan) => plan.technique))]);
  fill(storage, storages());
  technique.addEventListener('change', () => {
    fill(storage, storages());
    choose();
  });
  storage.addEventListener('change', choose);
  radius.addEventListener('change', compare);
  fog.addEventListener('change', breathe);
  await Promise.all([choose(), compare(), breathe()]);

  const line = element('line');
  const [left, right] = line.children;
  const draw = () => {
    const share = split.value / 100;
    line.hidden = share === 0 || share === 1;
    line.style.left = `${100 * share}%`;
    left.textContent = `${technique.value}, ${storage.value}`;
    right.textContent = 'percentage closer';
    renderer.draw(context.getCurrentTexture().createView(), {
      eye: orbit.eye,
      angle: radians(angle.value),
      split: share,
      radius: Number(radius.value),
      size: radians(size.value),
      air: fog.checked && renderer.air ? { density: Number(density.value), anisotropy: Number(anisotropy.value) } : undefined,
    });
  };
  const note = () => {
    if (split.value === '0') return 'percentage closer alone';
    return split.value === '100' ? `${technique.value} alone` : 'both techniques';
  };
  await page.run(device, draw, note);
}

main().catch((error) => page.stop(error.message));
