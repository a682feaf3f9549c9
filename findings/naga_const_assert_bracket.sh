#!/usr/bin/env bash
# naga 30.0.1 (compiler of wgpu and Firefox): a bracket right after `const_assert` is taken as the whole condition.
#
# Behaviour seen: `const_assert (1u << bits) == 32u;` is refused with "expected `;`, found "=="". The same condition in one more pair of
# brackets, or the other way round, is accepted. Tint accepts all three.
# A good guess: const_assert takes an expression (WGSL, "Const Assertion Statement"), as `if` does.
# Who meets it: authors who check a size or a shift in a shader that Chromium takes; it fails in Firefox and in native wgpu alone.
# Output seen (2026-11-29): bracket first: refused, expected `;`, found "=="; all in brackets: accepted; number first: accepted.
#
# Run by hand: findings/naga_const_assert_bracket.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --root "$folder" naga-cli@30.0.1

# judged CONDITION: what naga says to a shader that asserts it.
judged() {
  printf 'const bits = 5u;\nconst_assert %s;\n' "$1" > "$folder/assertion.wgsl"
  if "$folder/bin/naga" "$folder/assertion.wgsl" > "$folder/said" 2>&1; then
    echo accepted
  else
    echo "refused, $(sed -n 's/^error: //p' "$folder/said")"
  fi
}

bracket_first=$(judged '(1u << bits) == 32u')
in_brackets=$(judged '((1u << bits) == 32u)')
number_first=$(judged '32u == (1u << bits)')
echo "bracket first: $bracket_first; all in brackets: $in_brackets; number first: $number_first"
if [ "$bracket_first/$in_brackets/$number_first" = 'refused, expected `;`, found "=="/accepted/accepted' ]; then
  echo "as found"
else
  echo "this has changed"
  exit 1
fi
