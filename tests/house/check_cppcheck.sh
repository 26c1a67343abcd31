#!/usr/bin/env bash
# cppcheck over the library and the programs. What is left out, and why:
#   constStatement  takes `a[i] += b[i];` for a statement without effect (2.10); gcc warns of those
#   passedByValue   in the kernels: vectors of one or two registers, which by reference go to memory
set -euo pipefail
cd "$1"
cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet -j "$(nproc)" \
  --template='{file}:{line}: {severity}: {id}: {message}' --error-exitcode=1 -I src \
  --suppress=constStatement --suppress='passedByValue:src/rondo/integrators/fused/kernels/*' src apps
