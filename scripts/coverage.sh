#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Lines and branches of src/ and apps/ that the fast suite reaches, by module, and each file's
# missing lines in build/coverage/report.txt. Arguments go to ctest in place of `-L fast`.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh --dev
cmake --preset coverage
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
[ $# -gt 0 ] || set -- -L fast
ctest --test-dir build/coverage --output-on-failure -j "$(nproc)" "$@"
# What only an exception of a called function takes is no branch of the source.
gcovr --root . --filter src/ --filter apps/ --exclude-throw-branches --exclude-unreachable-branches \
  -j "$(nproc)" --txt build/coverage/report.txt --json-summary build/coverage/summary.json \
  build/coverage
/usr/bin/python3 - <<'TABLE'
import json
modules = {}
for file in json.load(open("build/coverage/summary.json"))["files"]:
    parts = file["filename"].split("/")  # src/rondo/MODULE/... or apps/PROGRAM/...
    for name in (parts[2] if parts[0] == "src" else parts[1], "all"):
        counts = modules.setdefault(name, [0] * 4)
        for i, what in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
            counts[i] += file[what]
for name, (lines, n, branches, m) in sorted(modules.items(), key=lambda item: item[0] == "all"):
    print(f"{name:12} lines {lines:6} of {n:6} {lines / max(n, 1):6.1%}"
          f"   branches {branches:6} of {m:6} {branches / max(m, 1):6.1%}")
TABLE
