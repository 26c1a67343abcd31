#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Where the packages are installed and there is nothing of the sources or the build: everything that they
# promise is used once.   in_root.sh MODULE, the file of the module of Python, "" where there is none
set -euo pipefail
module=$1
export PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg
mkdir /tmp/used
cd /tmp/used
rondo --version
rondo run /usr/share/rondo/cases/crush-smooth.toml -o pressed --set analysis.increments=3 --quiet
test -f pressed/results.h5
rondo check /usr/share/rondo/cases/tyre-section.toml >check.txt # by rondo-mesh-reader
grep -q nodes check.txt

for page in rondo.1 rondo-run.1 rondo-case.5; do
  test -f "/usr/share/man/man${page##*.}/$page.gz"
  ! command -v man >/dev/null || man -w "${page##*.}" "${page%.*}"
done
if command -v man >/dev/null; then man rondo-run | grep -q -- --resume; fi
test -f /usr/share/doc/rondo/docs/cases.md

RONDO=rondo RONDO_COMPLETION=/usr/share/bash-completion/completions/rondo \
  python3 /tmp/debs/test_completion.py
test -z "$module" || python3 /tmp/debs/use_package.py /usr "$module" ""
python3 -m rondo --version

if command -v cmake >/dev/null && command -v ninja >/dev/null; then
  cmake -S /tmp/debs/consumer -B built -G Ninja >/dev/null
  cmake --build built >/dev/null
  ./built/consumer /usr/share/rondo/cases/ledge-smooth.toml
else
  echo "LEFT OUT: a program that uses the library: no cmake, no ninja"
fi
