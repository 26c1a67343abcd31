#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs, builds and runs the tests; ends with ctest's summary. Arguments go to ctest, for example
#   bash scripts/test.sh -R cli_       the program, driven from outside
# Long runs: scripts/long.sh. Format and static analysis: scripts/lint.sh.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh --dev
cmake --preset release -DRONDO_BUILD_TESTS=ON -DRONDO_WERROR=ON
cmake --build --preset release
ctest --test-dir build/release --output-on-failure -j "$(nproc)" -LE long "$@"
