// Links shaders by wesl-js, npm's linker of WESL, with the library's own npm package installed.
//
// usage: node wesl.mjs FOLDER
// FOLDER/package holds shaders NAME.wgsl that import from the package `moment_shadows`, FOLDER/copied the same for a user
// who has the modules as files in a folder of their own, which lies there too. What is linked is written beside each shader,
// as NAME.linked.

import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { weslBundle } from 'moment-shadows';
import { link } from 'wesl/core';

// The files of a folder and of those in it: texts by path.
function texts(folder) {
  const found = {};
  for (const path of readdirSync(folder, { recursive: true })) {
    if (path.endsWith('.wgsl')) found[path.replaceAll('\\', '/')] = readFileSync(join(folder, path), 'utf8');
  }
  return found;
}

async function main(folder) {
  let failed = 0;
  let count = 0;
  for (const [place, libs] of [['package', [weslBundle]], ['copied', []]]) {
    const weslSrc = texts(join(folder, place));
    for (const file of Object.keys(weslSrc).filter((path) => !path.includes('/'))) {
      const path = join(folder, place, file);
      try {
        const linked = await link({ rootModuleName: basename(file, '.wgsl'), libs, weslSrc });
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
