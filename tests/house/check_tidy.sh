#!/usr/bin/env bash
# The short clang-tidy list of .clang-tidy over the library and the program.
set -euo pipefail
build=$1 source=$2
noise=$(mktemp)
trap 'rm -f "$noise"' EXIT
cd "$source"
find src apps -name '*.cpp' -print0 |
  xargs -0 -n 4 -P "$(nproc)" clang-tidy -p "$build" --quiet 2>"$noise" ||
  { cat "$noise"; exit 1; }
