#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Packs the build for Debian, looks at the packages, installs them, uses them and removes them again:
#   bash tests/packages/deb.sh BUILD SOURCE           above this machine's own files, which stay as they are
#   bash tests/packages/deb.sh BUILD SOURCE --clean   above a new Debian, made by mmdebstrap: minutes, network
# Exit code 77: the packages are right, but nothing could be mounted, or there is no mmdebstrap.
set -euo pipefail
build=$1 source=$2 kind=${3:-}
here=$source/tests/packages
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cpack --config "$build/CPackConfig.cmake" -B "$work/packed" >"$work/cpack.log" 2>&1 || {
  cat "$work/cpack.log"
  exit 1
}
mkdir "$work/debs"
mv "$work"/packed/*.deb "$work/debs"
rm -rf "$work/packed"
ls -l "$work/debs"
/usr/bin/python3 -B "$here/look_at_debs.py" "$work/debs" "$build" "$source"

lower=/
if [ "$kind" = --clean ]; then
  command -v mmdebstrap >/dev/null || { echo "LEFT OUT: no mmdebstrap"; exit 77; }
  lower=$work/debian
  codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mmdebstrap --variant=minbase --include=man-db,g++,cmake,ninja-build "$codename" "$lower" >"$work/debian.log" 2>&1 || {
    tail -20 "$work/debian.log"
    exit 1
  }
fi
unshare --mount true 2>/dev/null || {
  echo "LEFT OUT: the packages are neither installed nor removed: this user may not mount (not root?)"
  exit 77
}
cp -r "$here/in_root.sh" "$here/test_completion.py" "$here/consumer" "$source/tests/house/use_package.py" "$work/debs"
apart=(--mount)
[ -n "$kind" ] || apart+=(--net) # what the packages need is there already, or the test fails
unshare "${apart[@]}" bash "$here/above.sh" "$lower" "$work/debs" "$kind" \
  "$(sed -n 's/^RONDO_PYTHON_MODULE:INTERNAL=//p' "$build/CMakeCache.txt")"
