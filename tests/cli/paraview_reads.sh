#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A short run, read by each of ParaView's XDMF readers. Exits 77 where there is no ParaView.
set -euo pipefail
rondo=$1
command -v pvpython >/dev/null || { echo "skipped: ParaView's pvpython is not installed"; exit 77; }
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$rondo" run "$here/../../cases/rolling-flat.toml" -o "$work/run" --quiet \
  --set output.snapshots=7 --set time.end=0.03
for reader in XDMFReader Xdmf3ReaderT Xdmf3ReaderS; do
  echo "== $reader"
  pvpython "$here/read_fields.py" "$work/run" --reader "$reader" --times 7 --stress
done
