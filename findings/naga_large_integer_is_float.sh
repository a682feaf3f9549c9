#!/usr/bin/env bash
# naga 30.0.1 (compiler of wgpu and Firefox): an integer constant that does not fit in i32 becomes a float without a word.
#
# Behaviour seen: `let cells = 65536 * 65536;` is of type f32, and `var cells = 4294967296;` as well. What is computed with it after that
# is computed in floats.
# A good guess: an error, as Tint gives: "value 4294967296 cannot be represented as 'i32'". An abstract integer turns into i32 where nothing
# else is asked for (WGSL, "Overload resolution" and "let declarations").
# Who meets it: authors of hashes, bit masks and sizes without a suffix; where no other type meets the value nothing is said at all.
# Output seen (2026-11-29): let of a product: f32; var of a literal: f32; let of a small product: i32.
#
# Run by hand: findings/naga_large_integer_is_float.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --root "$folder" naga-cli@30.0.1

# type_of DECLARATION: the type that naga gives to `cells`, as it writes it, or the reason for a refusal.
type_of() {
  printf '@compute @workgroup_size(1) fn main() { %s = %s; var copy = cells; }\n' "$1" "$2" > "$folder/cells.wgsl"
  if "$folder/bin/naga" "$folder/cells.wgsl" "$folder/written.wgsl" > "$folder/said" 2>&1; then
    sed -n 's/.*var copy: \([a-z0-9]*\).*/\1/p' "$folder/written.wgsl"
  else
    echo "refused, $(sed -n 's/^error: //p' "$folder/said")"
  fi
}

product=$(type_of 'let cells' '65536 * 65536')
literal=$(type_of 'var cells' '4294967296')
small=$(type_of 'let cells' '256 * 256')
echo "let of a product: $product; var of a literal: $literal; let of a small product: $small"
if [ "$product/$literal/$small" = f32/f32/i32 ]; then
  echo "as found"
else
  echo "this has changed"
  exit 1
fi
