#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The long figures of docs/validation.md and docs/reliability.md: runs of 10^6 and 10^7 steps, the
# finest meshes, whole studies; then both sanitizers over all their tests, of which .ci/run has the
# short ones. Arguments go to ctest, and leave the sanitizers out:
#   bash scripts/long.sh -R Ledger     only these
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh --dev
cmake --preset release -DRONDO_BUILD_TESTS=ON -DRONDO_WERROR=ON
cmake --build --preset release
ctest --test-dir build/release --output-on-failure -j "$(nproc)" -L long "$@"
[ $# -gt 0 ] || bash scripts/sanitize.sh
