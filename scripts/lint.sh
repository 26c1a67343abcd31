#!/usr/bin/env bash
# What is to be said of the sources without running them: format, layers, clocks, clang-tidy,
# cppcheck, types of the Python package.
#   bash scripts/lint.sh                   the whole tree
#   bash scripts/lint.sh --changed [REV]   only what differs from REV, or is new; REV: where the branch
#                                          left origin/main, or else the commit before
# clang-tidy keeps what it found clean in build/lint and looks again only where something changed.
# Exit code 1: findings, which are printed. Exit code 2: wrong arguments.
set -euo pipefail
cd "$(dirname "$0")/.."

changed=no
case ${1:-} in
  '') ;;
  --changed) changed=yes ;;
  *) sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
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
  local name=$1 begin=$SECONDS
  shift
  if "$@"; then
    echo "lint: $name: clean, $((SECONDS - begin)) s"
  else
    failed+=("$name")
    echo "lint: $name: FINDINGS above, $((SECONDS - begin)) s"
  fi
}

format() {
  those '^(src|apps|tests|bench)/.*\.(cpp|hpp)$' | xargs -r -d '\n' clang-format --dry-run -Werror
}

layers() { /usr/bin/python3 tests/house/check_layers.py; }
clocks() { /usr/bin/python3 tests/house/check_clocks.py; }

# What is left out, and why:
#   constStatement  takes `a[i] += b[i];` for a statement without effect (2.10); gcc warns of those
#   passedByValue   in the kernels: vectors of one or two registers, which by reference go to memory
cppcheck_() {
  local sources
  mapfile -t sources < <(those '^(src|apps)/.*\.cpp$')
  [ ${#sources[@]} -gt 0 ] || return 0
  mkdir -p "$work/cppcheck"
  cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet \
    -j "$(nproc)" --template='{file}:{line}: {severity}: {id}: {message}' --error-exitcode=1 -I src \
    --cppcheck-build-dir="$work/cppcheck" --suppress=constStatement \
    --suppress='passedByValue:*/kernels/*' "${sources[@]}"
}

types() {
  [ -n "$(those '^python/.*\.py$')" ] || return 0
  (cd python && /usr/bin/python3 -m mypy --ignore-missing-imports --disallow-untyped-defs \
    --cache-dir "$OLDPWD/$work/mypy" rondo)
}

tidy() {
  those '^((src|apps)/.*\.(cpp|hpp)|\.clang-tidy)$' >"$work/files.txt"
  [ -s "$work/files.txt" ] || return 0
  cmake -S . -B "$work/clang" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_C_COMPILER=clang -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DRONDO_BUILD_TESTS=OFF \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >"$work/cmake.log" ||
    { cat "$work/cmake.log"; return 1; }
  local seconds=0
  [ "$changed" = no ] || seconds=30
  /usr/bin/python3 scripts/lint/tidy.py "$work/clang" "$work/tidy" "$seconds" <"$work/files.txt"
}

part format format
part layers layers
part clocks clocks
part types types
part cppcheck cppcheck_
part clang-tidy tidy
[ ${#failed[@]} -eq 0 ] && exit 0
echo "lint: findings of: ${failed[*]}" >&2
exit 1
