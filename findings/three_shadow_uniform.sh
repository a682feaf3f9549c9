#!/usr/bin/env bash
# three.js r187 (npm `three` 0.187.0, WebGPURenderer): a uniform in a light's shadow filter keeps its first value.
#
# Behaviour seen: `light.shadow.filterNode` uses `share = uniform(1)`. A later `share.value = 0` is not seen by meshes whose material, geometry and
# place stay as they are: the picture is that of 1. The same uniform as a material's `colorNode` is seen at once, and in the filter too after
# `share.setGroup(renderGroup)`, which three.js's own filters do.
# Expected: what a node's uniform says is seen by the next frame, wherever the node is used.
# A good guess: uniforms of an object are only sent where the object is found to have changed, and nodes are looked for in its material, not in
# its lights.
# Who meets it: authors of shadow filters with a setting, such as a width or a strength.
# Output seen (2026-11-29, Chromium 148): filter 1 -> 1, filter in the render's group 1 -> 0, colour 1 -> 0.
#
# Run by hand: findings/three_shadow_uniform.sh. Needs node, npm and Debian's package chromium. Exits with 0 as long as this is so, with 1 if
# it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 playwright-core@1.61.1
cat > page.html <<'HTML'
<!doctype html>
<script type="importmap">{ "imports": { "three": "/three.webgpu.js", "three/tsl": "/three.tsl.js" } }</script>
<script type="module">
  import * as THREE from 'three';
  import { Fn, renderGroup, uniform, vec3 } from 'three/tsl';

  const renderer = new THREE.WebGPURenderer();
  await renderer.init();
  renderer.shadowMap.enabled = true;
  const target = new THREE.RenderTarget(64, 64);

  // How bright a lit plane is before and after the uniform goes from 1 to 0, as a share of the brightness at 1.
  async function brightness(make) {
    const share = uniform(1);
    const light = new THREE.DirectionalLight(0xffffff, 3);
    light.position.set(0, 0, 5);
    light.castShadow = true;
    const material = new THREE.MeshLambertNodeMaterial();
    make(share, light, material);
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    mesh.receiveShadow = true;
    const scene = new THREE.Scene();
    scene.add(mesh, light);
    const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
    camera.position.z = 5;
    const seen = [];
    for (const value of [1, 1, 0, 0]) {
      share.value = value;
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      const pixels = await renderer.readRenderTargetPixelsAsync(target, 32, 32, 1, 1);
      seen.push(pixels[0]);
      await new Promise(requestAnimationFrame);
    }
    return `${seen[1] / seen[0]} -> ${seen[3] / seen[0]}`;
  }

  const filtered = (share, light) => (light.shadow.filterNode = Fn(() => share));
  globalThis.found = {
    filter: await brightness((share, light) => filtered(share, light)),
    "filter in the render's group": await brightness((share, light) => filtered(share.setGroup(renderGroup), light)),
    colour: await brightness((share, light, material) => (material.colorNode = vec3(share))),
  };
</script>
HTML
cat > drive.mjs <<'JS'
import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';
import { chromium } from 'playwright-core';

const server = createServer(({ url }, response) => {
  const isScript = url.endsWith('.js');
  response.setHeader('content-type', isScript ? 'text/javascript' : 'text/html');
  response.end(readFileSync(isScript ? `node_modules/three/build${url}` : 'page.html'));
}).listen(0, 'localhost');
const flags = ['--enable-unsafe-webgpu', '--enable-features=Vulkan', '--use-webgpu-adapter=swiftshader', '--use-vulkan=swiftshader', '--use-angle=swiftshader'];
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', ...flags] });
const page = await browser.newPage();
page.on('pageerror', (error) => console.error(error.message));
await page.goto(`http://localhost:${server.address().port}/`);
await page.waitForFunction(() => globalThis.found, undefined, { timeout: 60_000 });
const found = await page.evaluate(() => globalThis.found);
await browser.close();
server.close();
for (const [name, seen] of Object.entries(found)) console.log(`${name}: ${seen}`);
const isAsFound = Object.values(found).join() === '1 -> 1,1 -> 0,1 -> 0';
console.log(isAsFound ? 'as found' : 'this has changed');
process.exit(isAsFound ? 0 : 1);
JS
node drive.mjs
