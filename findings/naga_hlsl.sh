#!/usr/bin/env bash
# naga 30.0.1 (HLSL backend): two texts that a compiler of HLSL takes and that mean something else than the WGSL.
#
# Behaviour seen: naga ends with 0 and writes
#   matrix   `s.m = ...`, m a matrix of two rows in a struct: a helper `void SetMatmOnS(S obj, ...)`, which changes a copy; the store is lost
#   sign     `given[0] = sign(x)` of a float: `asuint(sign(x))`; HLSL's `sign` gives an int, so that 1 is stored as 0x00000001
# A good guess: `inout S obj`, and `asuint(float(sign(x)))`.
# Who meets it: wgpu on Direct3D 12, and whoever translates WGSL to HLSL. Our exports refuse both (`src/export/guard.rs`).
# Output seen (2026-11-29): matrix: by value; sign: an integer's bits
#
# Run by hand: findings/naga_hlsl.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --root "$folder" naga-cli@30.0.1
cat >"$folder/stores.wgsl" <<'WGSL'
struct S { m: mat2x2f }
@group(0) @binding(0) var<storage, read_write> given: array<f32, 2>;
@compute @workgroup_size(1)
fn main() {
    var s: S;
    s.m = mat2x2f(1.0, 2.0, 3.0, 4.0);
    given[0] = sign(given[1]);
    given[1] = s.m[0].x;
}
WGSL
"$folder/bin/naga" "$folder/stores.wgsl" "$folder/stores.hlsl"
changed=0
# found NAME WHAT PATTERN: the text has it.
found() {
  if grep -q "$3" "$folder/stores.hlsl"; then
    echo "$1: $2"
  else
    echo "$1: this has changed"
    changed=1
  fi
}
found matrix 'by value' '^void SetMatmOnS(S obj, '
found sign "an integer's bits" 'given.Store(0, asuint(sign('
exit "$changed"
