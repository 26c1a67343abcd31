#!/usr/bin/env bash
# Every C++ file as clang-format would write it.
set -euo pipefail
cd "$1"
find src apps tests bench \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 clang-format --dry-run -Werror
