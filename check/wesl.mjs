// Links shaders by wesl-js, npm's linker of WESL.
//
// usage: node wesl.mjs FOLDER
// FOLDER/package holds shaders NAME.wgsl that import from the package `moment_shadows`, FOLDER/copied the same for a user
// who has copied the modules into a folder `shadows` of their own, with imports spread over several lines. What is linked is
// written beside, as NAME.linked.

import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { link } from 'wesl/core';

const library = join(dirname(fileURLToPath(import.meta.url)), '../wgsl');

// The library's modules: texts by path.
const modules = {};
for (const path of readdirSync(library, { recursive: true })) {
  if (path.endsWith('.wgsl')) modules[path.replaceAll('\\', '/')] = readFileSync(join(library, path), 'utf8');
}
const spread = (line) => line.replace('{', '{\n    ').replaceAll(', ', ',\n    ').replace('}', ',\n}');
const copied = {};
for (const [path, text] of Object.entries(modules)) {
  copied[`shadows/${path}`] = text.replace(/^import .*$/gm, spread);
}

// What the linker takes besides the shader, by the place where the modules are.
const PLACES = {
  package: { libs: [{ name: 'moment_shadows', edition: '2026_pre', modules }], weslSrc: {} },
  copied: { libs: [], weslSrc: copied },
};

async function main(folder) {
  let failed = 0;
  let count = 0;
  for (const [place, { libs, weslSrc }] of Object.entries(PLACES)) {
    const shaders = readdirSync(join(folder, place)).filter((file) => file.endsWith('.wgsl'));
    for (const file of shaders) {
      const path = join(folder, place, file);
      try {
        const main = readFileSync(path, 'utf8');
        const linked = await link({ rootModuleName: 'main', libs, weslSrc: { ...weslSrc, 'main.wgsl': main } });
        writeFileSync(path.replace(/wgsl$/, 'linked'), linked.dest);
        count += 1;
      } catch (error) {
        console.error(`${place}/${file}: ${error.message}`);
        failed += 1;
      }
    }
  }
  console.log(`wesl-js: ${count} shaders linked, ${failed} refused`);
  return failed === 0 && count > 0;
}

if (process.argv.length !== 3) {
  console.error('usage: node wesl.mjs FOLDER');
  process.exit(2);
}
process.exitCode = (await main(process.argv[2])) ? 0 : 1;
