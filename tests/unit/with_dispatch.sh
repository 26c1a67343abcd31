#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# with_dispatch.sh LEVEL PROGRAM ARGUMENT...: PROGRAM with the loops of an instruction set. Exits 77 where the
# processor does not have it, or has none better: the test without this script then ran the same loops.
set -euo pipefail
case $1 in
  avx2) needed="avx2 fma" ;;
  baseline) needed="" ;;
  *) echo "no such instruction set: $1"; exit 2 ;;
esac
for flag in $needed; do
  grep -qw "$flag" /proc/cpuinfo || { echo "skipped: this processor has no $flag"; exit 77; }
done
if [ "$1" = avx2 ] && ! grep -qw avx512f /proc/cpuinfo; then
  echo "skipped: avx2 is the best that this processor has, with which the same tests ran"
  exit 77
fi
RONDO_DISPATCH=$1 exec "${@:2}"
