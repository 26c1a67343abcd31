#!/usr/bin/env bash
# The short clang-tidy list of .clang-tidy over the library and the program. OpenMP flags of g++ are
# dropped where clang has no runtime of its own: tidy only reads.
set -euo pipefail
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed 's/-fopenmp//g' "$build/compile_commands.json" >"$work/compile_commands.json"
cd "$source"
find src apps -name '*.cpp' -print0 |
  xargs -0 -n 4 -P "$(nproc)" clang-tidy -p "$work" --quiet 2>"$work/noise" ||
  { cat "$work/noise"; exit 1; }
