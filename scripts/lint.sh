#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What is to be said of the sources without running them: format, layers, clocks, licences, clang-tidy,
# cppcheck, types of the Python package.
#   bash scripts/lint.sh                   the whole tree
#   bash scripts/lint.sh --changed [REV]   only what differs from REV, or is new; REV: where the branch
#                                          left origin/main, or else the commit before
#                                          ends within about 40 s and says what it did not come to
# clang-tidy keeps what it found clean in build/lint and looks again only where something changed.
# Exit code 1: findings, which are printed. Exit code 2: wrong arguments.
set -euo pipefail
cd "$(dirname "$0")/.."

changed=no
case ${1:-} in
  '') ;;
  --changed) changed=yes ;;
  *) sed -n '3,11s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
if [ "$changed" = yes ]; then
  rev=${2:-$(git merge-base HEAD origin/main 2>/dev/null || true)}
  [ -n "$rev" ] && { [ -n "${2:-}" ] || [ "$(git rev-parse "$rev")" != "$(git rev-parse HEAD)" ]; } ||
    rev=HEAD~
  git rev-parse --verify --quiet "$rev^{commit}" >/dev/null ||
    { echo "lint: no commit $rev to compare with" >&2; exit 2; }
  mapfile -t files < <({ git diff --name-only --diff-filter=d "$rev" --
                         git ls-files --others --exclude-standard; } | sort -u)
  echo "lint: ${#files[@]} files differ from $rev"
else
  bash scripts/setup.sh --dev
  mapfile -t files < <(git ls-files --cached --others --exclude-standard)
fi

those() { # REGEX: of the files, those of this name that are there
  local file
  for file in "${files[@]}"; do
    [[ $file =~ $1 && -f $file ]] && printf '%s\n' "$file"
  done
  return 0
}

work=build/lint
mkdir -p "$work"
failed=()
part() { # NAME COMMAND...
  local name=$1 begin=$SECONDS outcome=0
  shift
  "$@" || outcome=$?
  case $outcome in
    0) echo "lint: $name: clean, $((SECONDS - begin)) s" ;;
    124) echo "lint: $name: NOT FINISHED in the time of --changed: bash scripts/lint.sh" ;;
    *)
      failed+=("$name")
      echo "lint: $name: FINDINGS above, $((SECONDS - begin)) s"
      ;;
  esac
}

seconds_left() { # of the time of --changed, for what should end at second $1
  echo $(($1 > SECONDS ? $1 - SECONDS : 1))
}

limited() { # COMMAND..., exit code 124 where the time of --changed ran out
  if [ "$changed" = yes ]; then timeout "$(seconds_left 35)" "$@"; else "$@"; fi
}

format() {
  those '^(src|apps|tests|bench|python)/.*\.(cpp|hpp)$' | xargs -r -d '\n' clang-format --dry-run -Werror
}

layers() { /usr/bin/python3 tests/house/check_layers.py; }
clocks() { /usr/bin/python3 tests/house/check_clocks.py; }
# Every file has a licence and its holder, by a line of its own or .reuse/dep5.
licences() { /usr/bin/python3 tests/packages/test_licences.py && reuse lint --quiet; }

# What is left out, and why:
#   constStatement  takes `a[i] += b[i];` for a statement without effect (2.10); gcc warns of those
#   passedByValue   vectors of two or three numbers and of registers are values; what is dear to copy
#                   clang-tidy finds (performance-unnecessary-value-param)
cppcheck_() {
  local sources
  mapfile -t sources < <(those '^(src|apps)/.*\.cpp$')
  [ ${#sources[@]} -gt 0 ] || return 0
  mkdir -p "$work/cppcheck"
  limited cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet \
    -j "$(nproc)" --template='{file}:{line}: {severity}: {id}: {message}' --error-exitcode=1 -I src \
    --cppcheck-build-dir="$work/cppcheck" --suppress=constStatement \
    --suppress=passedByValue "${sources[@]}"
}

types() {
  [ -n "$(those '^(python|scripts/pages)/.*\.py$')" ] || return 0
  (cd python && limited /usr/bin/python3 -m mypy --ignore-missing-imports --disallow-untyped-defs \
    --cache-dir "$OLDPWD/$work/mypy" rondo build_module.py build_wheel.py) &&
    limited /usr/bin/python3 -m mypy --disallow-untyped-defs --cache-dir "$work/mypy" scripts/pages/*.py
}

tidy() {
  those '^((src|apps)/.*\.(cpp|hpp)|\.clang-tidy)$' >"$work/files.txt"
  [ -s "$work/files.txt" ] || return 0
  cmake -S . -B "$work/clang" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_COMPILER=clang -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DRONDO_BUILD_TESTS=OFF -DRONDO_UNITY=OFF \
    >"$work/cmake.log" ||
    { cat "$work/cmake.log"; return 1; }
  local seconds=0
  [ "$changed" = no ] || seconds=$(seconds_left 28)
  /usr/bin/python3 scripts/lint/tidy.py "$work/clang" "$work/tidy" "$seconds" <"$work/files.txt"
}

part format format
part layers layers
part clocks clocks
part licences licences
part clang-tidy tidy
part cppcheck cppcheck_
part types types
[ ${#failed[@]} -eq 0 ] && exit 0
echo "lint: findings of: ${failed[*]}" >&2
exit 1
