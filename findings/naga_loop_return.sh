#!/usr/bin/env bash
# naga 30.0.1 (compiler of wgpu and Firefox): a function that leaves its last loop by `return` alone is refused for a missing return.
#
# Behaviour seen: `loop { if i > n { return i; } i++; }` at the end of a function is refused: "The `return` expression None does not match
# the declared return type". With an unreachable `return` after the loop naga accepts it, and Tint accepts both.
# A good guess: a loop without `break` is left by `return` only, so nothing is missing (WGSL, "Behavior of Statements").
# Who meets it: authors of searches and rejection sampling that Chromium takes; they fail in Firefox and in native wgpu alone.
# Output seen (2026-11-29): as it is: refused, The `return` expression None does not match; with a return after the loop: accepted.
#
# Run by hand: findings/naga_loop_return.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cargo install --quiet --locked --root "$folder" naga-cli@30.0.1

# judged STATEMENT: what naga says to a function with this statement after its loop.
judged() {
  cat > "$folder/search.wgsl" <<WGSL
fn search(n: i32) -> i32 {
    var i = 0;
    loop {
        if i > n { return i; }
        i++;
    }
    $1
}
WGSL
  if "$folder/bin/naga" "$folder/search.wgsl" > "$folder/said" 2>&1; then
    echo accepted
  else
    echo "refused, $(grep -o 'The `return` expression None does not match' "$folder/said" || echo otherwise)"
  fi
}

as_it_is=$(judged '')
with_return=$(judged 'return 0;')
echo "as it is: $as_it_is; with a return after the loop: $with_return"
if [ "$as_it_is/$with_return" = 'refused, The `return` expression None does not match/accepted' ]; then
  echo "as found"
else
  echo "this has changed"
  exit 1
fi
