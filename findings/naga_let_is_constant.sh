#!/usr/bin/env bash
# naga 30.0.1 (compiler of wgpu and Firefox): the value of a `let` counts as a constant, so valid shaders are refused for it.
#
# Behaviour seen: `let steps = 0; return 100 / steps;` is refused ("Division by zero"), and so are `1u << bits` with `let bits = 32u` and
# `a[i]` with `let i = 4` for an array of four. Tint accepts all three: a `let` is a value of run time (WGSL, "Value Declarations"), where
# the quotient, the shift and the index have defined results. With `var` in place of `let` naga accepts them too. The other way round it
# takes `case n` with `let n = 1`, which Tint refuses: selectors are constants.
# A good guess: constants are what is declared by `const`, and literals.
# Who meets it: authors who switch a feature off by `let enabled = 0`, or guard a division by an `if`; the shader runs in Chromium, and fails in
# Firefox and in native wgpu alone.
# Output seen (2026-11-29): division refused, with var accepted; shift refused, with var accepted; index refused, with var accepted.
#
# Run by hand: findings/naga_let_is_constant.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --root "$folder" naga-cli@30.0.1

# judged WGSL: what naga says.
judged() {
  echo "$1" > "$folder/shader.wgsl"
  if "$folder/bin/naga" "$folder/shader.wgsl" > /dev/null 2>&1; then echo accepted; else echo refused; fi
}

changed=0
# compared NAME WGSL: what naga says of the shader, and of the one with `var` for DECLARE.
compared() {
  local as_let as_var
  as_let=$(judged "${2//DECLARE/let}")
  as_var=$(judged "${2//DECLARE/var}")
  echo "$1 $as_let, with var $as_var"
  if [ "$as_let/$as_var" != refused/accepted ]; then changed=1; fi
}
compared division 'fn f() -> i32 { DECLARE steps = 0; return 100 / steps; }'
compared shift 'fn f() -> u32 { DECLARE bits = 32u; return 1u << bits; }'
compared index 'fn f(n: f32) -> f32 { var a = array(n, n, n, n); DECLARE i = 4; return a[i]; }'
if [ "$changed" = 0 ]; then echo "as found"; else echo "this has changed"; fi
exit "$changed"
