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
  // Fetched meanwhile; whoever waits for it hears of what went wrong.
  const listed = fetchPlan('index.json');
  listed.catch(() => {});
  const device = await openDevice((message) => page.stop(message));
  const context = page.picture.getContext('webgpu');
  const format = navigator.gpu.getPreferredCanvasFormat();
  context.configure({ device, format });
  const renderer = new Renderer(device, format);
  const orbit = new Orbit(page.picture, () => page.ask());
  const { plans, references } = await listed;
  await page.fit(device, (width, height) => {
    Object.assign(page.picture, { width, height });
    return renderer.resize(width, height);
  });

  const take = async (which, { file, map, name }) => renderer.take(which, await fetchPlan(file), { map, name });
  const chosen = () => {
    const isChosen = (plan) => plan.technique === technique.value && plan.storage === storage.value;
    const found = plans.find((plan) => isChosen(plan) && [null, Number(radius.value)].includes(plan.radius));
    return { ...found, name: `${found.technique}, ${found.storage}` };
  };
  const compared = () => take('reference', { file: references[radius.value], map: 'light_depth', name: 'percentage closer' });
  // What was there before stays where a plan cannot be had.
  const change = (work) => page.change(work, (error) => page.say(error.message));
  const choose = () => {
    const isSoft = chosen().radius === null;
    // The sun's size makes soft shadows, the width of the blur all others.
    element('blurred').hidden = isSoft;
    element('sized').hidden = !isSoft;
    return change(() => take('chosen', chosen()));
  };
  const storages = () => [...new Set(plans.filter((plan) => plan.technique === technique.value).map((plan) => plan.storage))];
  const breathe = async () => {
    if (fog.checked && !renderer.air) await change(() => take('air', { file: 'air.json' }));
    fog.checked &&= Boolean(renderer.air);
    element('air').disabled = !fog.checked;
  };

  fill(technique, [...new Set(plans.map((plan) => plan.technique))]);
  fill(storage, storages());
  technique.addEventListener('change', () => {
    fill(storage, storages());
    choose();
  });
  storage.addEventListener('change', choose);
  // One width after the other; those that have been passed over meanwhile are left out.
  let width = radius.value;
  const widen = async () => {
    if (width === radius.value) return;
    width = radius.value;
    await Promise.all([take('chosen', chosen()), compared()]);
  };
  radius.addEventListener('input', () => change(widen));
  fog.addEventListener('change', breathe);
  await page.change(() => take('chosen', chosen()));

  const line = element('line');
  const [left, right] = line.children;
  const draw = () => {
    const share = split.value / 100;
    line.hidden = share === 0 || share === 1 || !renderer.reference;
    line.style.left = `${100 * share}%`;
    [left.textContent, right.textContent] = [renderer.chosen.name, renderer.reference?.name];
    renderer.draw(context.getCurrentTexture().createView(), {
      eye: orbit.eye,
      angle: radians(angle.value),
      split: share,
      size: radians(size.value),
      air: fog.checked && renderer.air ? { density: Number(density.value), anisotropy: Number(anisotropy.value) } : undefined,
    });
  };
  const note = () => {
    const shown = renderer.shown(split.value / 100);
    return shown.length === 1 ? `${shown[0].name} alone` : 'both techniques';
  };
  await page.run(device, draw, note);
  // After the first frame, which need not wait for it.
  await change(compared);
}

main().catch((error) => page.stop(error.message));
