#!/usr/bin/env bash
# wgsl_reflect 1.6.0 (npm): names that WGSL allows are taken for keywords, and sizes of workgroups that are expressions are refused.
#
# Behaviour seen: parameters named `function`, `private`, `workgroup`, `uniform`, `storage`, `read`, `write`, `read_write` or `block` stop the parser
# ("Expected ')' for argument list", "Expected '{' for block" and the like, at the first use). In WGSL the words of address spaces and access
# modes are context-dependent names, not keywords ("Context-Dependent Names"), and `block` is none at all. Neither is
# `@workgroup_size(SIZE.x, SIZE.y)` taken, a const-expression, nor `texture_storage_2d<rgba16unorm, write>` of `texture-formats-tier1`.
# A good guess: address spaces and access modes are looked for within `<` and `>` only.
# Who meets it: authors of JavaScript tools that reflect other people's shaders.
# Output seen (2026-11-29): the nine names refused; workgroup_size(SIZE.x, SIZE.y) refused, (X, X) accepted; rgba16unorm refused.
#
# Run by hand: findings/wgsl_reflect_names.sh. Needs node and npm. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts wgsl_reflect@1.6.0
cp node_modules/wgsl_reflect/wgsl_reflect.module.js wgsl_reflect.mjs
cat > reflect.mjs <<'JS'
import { WgslReflect } from './wgsl_reflect.mjs';

function judged(text) {
  try {
    new WgslReflect(text);
    return 'accepted';
  } catch (error) {
    return 'refused';
  }
}

let changed = false;
function expect(name, text, expected) {
  const found = judged(text);
  console.log(`${name}: ${found}`);
  changed ||= found !== expected;
}

const using = (name) => `fn f(${name}: u32) -> u32 { if ${name} == 1u { return 2u * ${name} + min(${name}, 1u); } return 0u; }`;
expect('other', using('other'), 'accepted');
for (const name of ['function', 'private', 'workgroup', 'uniform', 'storage', 'read', 'write', 'read_write', 'block']) {
  expect(name, using(name), 'refused');
}
const sized = (size) => `const SIZE = vec2u(8u);\nconst X = 8u;\n@compute @workgroup_size(${size}) fn f() {}`;
expect('workgroup_size(X, X)', sized('X, X'), 'accepted');
expect('workgroup_size(SIZE.x, SIZE.y)', sized('SIZE.x, SIZE.y'), 'refused');
const stored = (format) => `@group(0) @binding(0) var map: texture_storage_2d<${format}, write>;`;
expect('rgba16float', stored('rgba16float'), 'accepted');
expect('rgba16unorm', stored('rgba16unorm'), 'refused');
console.log(changed ? 'this has changed' : 'as found');
process.exit(changed ? 1 : 0);
JS
node reflect.mjs
