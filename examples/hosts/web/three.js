// The page of three.js: its scene, its light and its shadow map, filtered by a plan.

import {
  BufferGeometry,
  Color,
  DirectionalLight,
  FrontSide,
  HemisphereLight,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  MeshLambertNodeMaterial,
  PerspectiveCamera,
  Scene,
  WebGPURenderer,
} from 'three';
import { openDevice } from './device.js';
import { FilteredShadow } from './filtered_shadow.js';
import { Orbit } from './orbit.js';
import { Page, element } from './page.js';
import { fetchPlan, fetchText } from './plans.js';
import { STRIDE, vertices } from './scene.js';
import { REACH, TARGET, ZOOM, sunTowards } from './view.js';

const page = new Page();
const [filter, radius, angle] = ['filter', 'radius', 'angle'].map(element);

// The share of the picture, from the left, that our filter is seen in.
const SHARES = { plan: 1, both: 0.5, three: 0 };

// The scene and the light of the other page.
function makeScene() {
  const scene = new Scene();
  scene.background = new Color().setRGB(0.3, 0.45, 0.68);
  const corners = new InterleavedBuffer(vertices(), STRIDE / 4);
  const geometry = new BufferGeometry();
  for (const [index, name] of ['position', 'normal', 'color'].entries()) {
    geometry.setAttribute(name, new InterleavedBufferAttribute(corners, 3, 3 * index));
  }
  // The sun sees what faces it. (By default three.js draws backs, and the bottom of a box lies in the ground that it stands on.)
  const mesh = new Mesh(geometry, new MeshLambertNodeMaterial({ vertexColors: true, shadowSide: FrontSide }));
  mesh.castShadow = mesh.receiveShadow = true;
  // A material reflects a share of 1 / pi.
  const sky = new HemisphereLight(new Color().setRGB(0.255, 0.289, 0.34), new Color().setRGB(0.075, 0.085, 0.1), Math.PI);
  const sun = new DirectionalLight(new Color().setRGB(1, 0.95, 0.85), 1.5 * Math.PI);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow.camera, { left: -REACH, right: REACH, top: REACH, bottom: -REACH, near: 0, far: 2 * REACH });
  scene.add(mesh, sky, sun);
  return { scene, sun };
}

async function main() {
  const device = await openDevice((message) => page.stop(message));
  const [plan, linked] = await Promise.all([fetchPlan('three.json'), fetchText('filtered_shadow.wgsl')]);
  const renderer = new WebGPURenderer({ canvas: page.picture, device });
  await renderer.init();
  renderer.shadowMap.enabled = true;
  const { scene, sun } = makeScene();
  const shadow = await FilteredShadow.create(renderer, sun, plan, linked);
  sun.shadow.shadowNode = shadow;

  const camera = new PerspectiveCamera();
  camera.near = 0.1;
  const orbit = new Orbit(page.picture, () => page.ask());
  await page.fit(device, (width, height) => {
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.fov = (2 * 180 * Math.atan(1 / (ZOOM * Math.min(camera.aspect, 1)))) / Math.PI;
    camera.updateProjectionMatrix();
  });
  // Pipelines are made beside the page's own work.
  page.change(() => renderer.compileAsync(scene, camera));
  await page.changes;

  const line = element('line');
  const draw = () => {
    const share = SHARES[filter.value];
    line.hidden = filter.value !== 'both';
    line.style.left = `${100 * share}%`;
    shadow.told.share.value = share;
    sun.shadow.radius = Number(radius.value);
    // What its own filter needs; ours derives its bias.
    sun.shadow.bias = -0.0018 * sun.shadow.radius;
    sun.position.set(...sunTowards((angle.value * Math.PI) / 180)).setLength(REACH);
    camera.position.set(...orbit.eye);
    camera.lookAt(...TARGET);
    renderer.render(scene, camera);
  };
  await page.run(device, draw, () => (filter.value === 'both' ? 'both filters' : `filtered by ${filter.selectedOptions[0].text}`));
}

main().catch((error) => page.stop(error.message));
