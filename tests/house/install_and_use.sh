#!/usr/bin/env bash
# Installs the build into a folder of its own, builds another program against it and runs both.
set -euo pipefail
build=$1 source=$2 build_type=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
"$work/prefix/bin/rondo" --version
test -f "$work/prefix/share/rondo/cases/ledge-smooth.toml"
cmake -S "$source/tests/house/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE="$build_type" \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/build"
"$work/build/consumer"
