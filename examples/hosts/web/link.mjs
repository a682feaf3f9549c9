// Links the shader for three.js with the library's modules, by npm's `wesl` and the library's package for it.
//
// usage: node link.mjs SHADER PACKAGE OUT
// PACKAGE is the folder that packages/npm/build.mjs has made.

import { readFileSync, writeFileSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { link } from 'wesl';

const [shader, folder, out] = process.argv.slice(2);
const { weslBundle } = await import(pathToFileURL(join(resolve(folder), 'dist/weslBundle.js')));
const weslSrc = { [basename(shader)]: readFileSync(shader, 'utf8') };
const linked = await link({ rootModuleName: basename(shader, '.wgsl'), weslSrc, libs: [weslBundle] });
writeFileSync(out, linked.dest);
