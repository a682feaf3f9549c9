#!/usr/bin/env bash
# naga 30 (naga-cli 30.0.1, GLSL backend): valid WGSL becomes GLSL that no compiler takes, or that means something else, without a word.
#
# Behaviour seen: naga ends with 0 and glslang refuses the text:
#   select        `select` of vec2<i32> by vec2<bool>, for ES 3.00: `mix` of integers, which is not there before ES 3.20
#   countOneBits  for ES 3.00: `bitCount`, which is not there before ES 3.10 (so are findMSB, findLSB, bitfieldExtract, ldexp, ...)
#   textureGather for ES 3.00: not there before ES 3.10
#   sample_mask   for 4.50: `uint m = gl_SampleMaskIn`, which is an array
#   layers        `textureGatherCompare` of layers, for 4.50: written with the two derivatives of `textureGrad`
#   depth         `textureSample` of a depth texture, for 4.50: `texture(sampler2DShadow, vec2)`, for which there is no such function
# and glslang takes one text that means something else:
#   gather        `textureGather` of a depth texture, for 4.50: `textureGather(sampler2DShadow, vec2, 0)`, which compares with 0
# A good guess: an error of naga's as for a version that lacks a feature (`MissingFeatures`), or text that works.
# Who meets it: wgpu on WebGL 2 and OpenGL, when a pipeline is made; a program that asks naga whether a shader can be had there.
#
# Run by hand: findings/naga_glsl.sh. Needs Debian with glslang-tools, and cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --version 30.0.1 --root "$folder" naga-cli
glslangValidator --version | head -n 1
cd "$folder"
changed=0
# refused NAME VERSION WGSL: naga writes it and glslang refuses it.
refused() {
  echo "$3" >"$1.wgsl"
  bin/naga --profile "$2" --entry-point main --shader-stage frag "$1.wgsl" "$1.frag" >/dev/null || { echo "$1: naga refuses it now" && changed=1 && return; }
  if glslangValidator "$1.frag" >"$1.log"; then
    echo "$1: taken" && changed=1
  else
    echo "$1: $(grep -m 1 ERROR "$1.log")"
  fi
}
refused select es300 '@fragment fn main(@location(0) @interpolate(flat) i: vec2i) -> @location(0) vec2i { return select(i, -i, i < vec2i(0)); }'
refused countOneBits es300 '@fragment fn main(@location(0) @interpolate(flat) i: u32) -> @location(0) u32 { return countOneBits(i); }'
refused textureGather es300 '@group(0) @binding(0) var t: texture_2d<f32>; @group(0) @binding(1) var s: sampler;
@fragment fn main(@location(0) p: vec2f) -> @location(0) vec4f { return textureGather(0, t, s, p); }'
refused sample_mask core450 '@fragment fn main(@builtin(sample_mask) m: u32) -> @location(0) u32 { return m; }'
refused layers core450 '@group(0) @binding(0) var t: texture_depth_2d_array; @group(0) @binding(1) var s: sampler_comparison;
@fragment fn main(@location(0) p: vec2f) -> @location(0) vec4f { return textureGatherCompare(t, s, p, 0, 0.5); }'
refused depth core450 '@group(0) @binding(0) var t: texture_depth_2d; @group(0) @binding(1) var s: sampler;
@fragment fn main(@location(0) p: vec2f) -> @location(0) vec4f { return vec4f(textureSample(t, s, p)); }'
cat >gather.wgsl <<'WGSL'
@group(0) @binding(0) var t: texture_depth_2d; @group(0) @binding(1) var s: sampler;
@fragment fn main(@location(0) p: vec2f) -> @location(0) vec4f { return textureGather(t, s, p); }
WGSL
bin/naga --profile core450 --entry-point main --shader-stage frag gather.wgsl gather.frag >/dev/null || changed=1
if glslangValidator gather.frag >/dev/null && grep -q 'sampler2DShadow' gather.frag && grep -q 'textureGather(.*, 0)' gather.frag; then
  echo "gather: taken, as $(grep -o 'textureGather(.*)' gather.frag) of a sampler2DShadow"
else
  echo "gather: this has changed" && changed=1
fi
exit "$changed"
