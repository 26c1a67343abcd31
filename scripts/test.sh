#!/usr/bin/env bash
# Installs, builds and runs all tests; ends with ctest's summary. Arguments go to ctest, for example
#   bash scripts/test.sh -L fast          without the long verification runs
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release -DRONDO_BUILD_TESTS=ON -DRONDO_WERROR=ON
cmake --build --preset release
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "$@"
