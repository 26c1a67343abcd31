#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds with sanitizers and runs the tests that they are for:
#   bash scripts/sanitize.sh asan [--short]
#                                     addresses, leaks, undefined behaviour: all tests but the long
#                                     ones; --short: the unit tests but those of dense algebra, and
#                                     the short ones of the program
#   bash scripts/sanitize.sh tsan [--short]
#                                     races: the threaded step, the writer thread, runs with both;
#                                     --short: the barrier and the threaded step
#   bash scripts/sanitize.sh clang    no test: warnings of clang are errors (asan is built with it too)
#   bash scripts/sanitize.sh          asan and tsan
# Whatever is found ends the process in question with exit code 99 and is kept in
# build/PRESET/findings: a finding fails the job even where a test does not ask how a process ended.
set -euo pipefail
cd "$(dirname "$0")/.."
suppressions=$PWD/scripts/sanitize

build() { # PRESET TARGET...
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" ${2:+--target "${@:2}"}
  rm -rf "build/$1/findings"
  mkdir -p "build/$1/findings"
}

no_findings() { # PRESET
  local found
  found=$(find "build/$1/findings" -type f -size +0)
  [ -z "$found" ] && return
  echo "sanitize: findings of preset $1:" >&2
  xargs -d '\n' head -n 60 <<<"$found" >&2
  return 1
}

asan() { # [--short]
  local tests=(-LE long)
  case ${1:-} in
    '') build asan ;;
    --short)
      tests=(-L short)
      build asan short_tests
      ;;
    *) usage ;;
  esac
  local common=exitcode=99:log_path=$PWD/build/asan/findings/report
  # Signals that a test sends itself, and traps that a test springs, are no findings; nor what ends the
  # library that reads meshes, which is why it has a process of its own (with the second runtime).
  ASAN_OPTIONS=$common:detect_leaks=1:strict_string_checks=1:check_initialization_order=1:handle_segv=0:handle_sigbus=0:handle_sigfpe=0 \
  UBSAN_OPTIONS=$common:print_stacktrace=1:handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_abort=0 \
  RONDO_TEST_TIMEOUT=900 LSAN_OPTIONS=suppressions=$suppressions/leaks.txt:print_suppressions=0 \
    ctest --test-dir build/asan "${tests[@]}" --output-on-failure -j "$(nproc)" ||
    { no_findings asan; return 1; }
  no_findings asan
}

tsan() { # [--short]
  local tests=(-L threads)
  case ${1:-} in
    '') build tsan thread_tests ;;
    --short)
      tests+=(-R '^unit_(core|integrators)')
      build tsan unit_core unit_integrators
      ;;
    *) usage ;;
  esac
  # libomp tells the sanitizer through Archer where threads wait for each other; without it each
  # parallel loop would be a race.
  local archer
  archer=$(find /usr/lib/llvm-*/lib -name libarcher.so | sort -V | tail -n 1)
  [ -n "$archer" ] || { echo "sanitize: no libarcher.so (package libomp-dev)" >&2; return 1; }
  # It finds no race in the kernels for AVX (docs/reliability.md).
  RONDO_DISPATCH=baseline OMP_TOOL_LIBRARIES=$archer \
  TSAN_OPTIONS=exitcode=99:log_path=$PWD/build/tsan/findings/report:ignore_noninstrumented_modules=1:handle_segv=0:handle_sigbus=0:handle_sigfpe=0 \
    ctest --test-dir build/tsan "${tests[@]}" --output-on-failure -j "$(nproc)" ||
    { no_findings tsan; return 1; }
  no_findings tsan
}

usage() {
  sed -n '3,12s/^# \{0,1\}//p' "$0" >&2
  exit 2
}

case ${1:-all} in
  asan) asan "${@:2}" ;;
  tsan) tsan "${@:2}" ;;
  clang) build clang ;;
  all) asan; tsan ;;
  *) usage ;;
esac
