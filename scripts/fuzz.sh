#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes what reads files (docs/reliability.md, Fuzzing): builds the libFuzzer targets of the preset
# asan and runs each on its corpus and on all that was found before, two at a time.
#   bash scripts/fuzz.sh [SECONDS] [TARGET...]      30 s and all targets by default
# SECONDS 0 only reads corpus and findings again. Exit code 1: a finding, whose file is named.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-30}
[ $# -eq 0 ] || shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for source in tests/fuzz/targets/*_fuzz.cpp; do
    targets+=("$(basename "$source" _fuzz.cpp)")
  done
fi

cmake --preset asan >/dev/null
cmake --build build/asan --target "${targets[@]/%/_fuzz}" rondo-mesh-reader

export RONDO_FUZZ_MESHES=$PWD/cases/meshes
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
export RONDO_TRAPS=off # numbers out of range are to be refused, not to end the program
ASAN_SYMBOLIZER_PATH=$(command -v llvm-symbolizer-14 || command -v llvm-symbolizer || true)
export ASAN_SYMBOLIZER_PATH

run_one() {
  local seconds=$1 target=$2 options=() jobs=() outcome=0
  # What HDF5 does to a process with damaged bytes; libFuzzer then ends with the last job's code.
  local in_jobs=(-fork=1 -ignore_timeouts=1 -ignore_ooms=1) timeout_code=70 memory_code=71
  local work=build/fuzz/$target scratch
  mkdir -p "$work/corpus" "$work/found"
  scratch=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d) # in memory: a file for each input
  case $target in
    case | build) options=(-dict=tests/fuzz/case.dict -max_len=4096) ;;
    study) options=(-dict=tests/fuzz/study.dict -max_len=4096) ;;
    results) options=(-max_len=8192) ;;
    results_bytes | checkpoint) options=(-max_len=30000) jobs=("${in_jobs[@]}") ;;
    *) options=(-max_len=8192) ;;
  esac
  if [ "$seconds" -gt 0 ]; then
    options+=("-max_total_time=$seconds" "${jobs[@]}")
  else
    options+=(-runs=0)
  fi
  case $target in # what HDF5 keeps of a damaged file is its own
    results* | checkpoint*) export ASAN_OPTIONS=detect_leaks=0 ;;
  esac
  local corpora=("$work/corpus" "tests/fuzz/corpus/$target")
  [ ! -d "tests/fuzz/findings/$target" ] || corpora+=("tests/fuzz/findings/$target")
  TMPDIR=$scratch "build/asan/${target}_fuzz" -timeout=25 -rss_limit_mb=2048 \
    -print_final_stats=1 "-artifact_prefix=$work/found/" "${options[@]}" "${corpora[@]}" \
    >"$work/log.txt" 2>&1 || outcome=$?
  rm -rf "$scratch"
  case "${options[*]}:$outcome" in
    *-ignore_timeouts=1*:$timeout_code | *-ignore_ooms=1*:$memory_code) outcome=0 ;;
  esac
  if [ "$outcome" -ne 0 ]; then
    echo "fuzz: $target: FINDING; the end of $work/log.txt:"
    tail -n 60 "$work/log.txt"
    echo "fuzz: again: build/asan/${target}_fuzz $(sed -n 's/.*Test unit written to //p' "$work/log.txt")"
    return 1
  fi
  echo "fuzz: $target: $(grep -E 'cov: ' "$work/log.txt" | tail -n 1)"
}
export -f run_one
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c 'run_one "$1" "$2"' run "$seconds" {} ||
  exit 1
echo "fuzz: ${#targets[@]} targets, $seconds s each: nothing found"
