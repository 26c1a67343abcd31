#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the build into a folder of its own, builds another program, the one that docs/library.md shows,
# and the example of an own material against it, and runs them. The headers are those of the list, and each stands by
# itself. Then the folder is moved, and the Python package works from there, with the library as its module and the programs.
set -euo pipefail
build=$1 source=$2 build_type=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
"$work/prefix/bin/rondo" --version
test -x "$work/prefix/bin/rondo-mesh-reader"
test -f "$work/prefix/share/rondo/cases/ledge-smooth.toml"
for file in "$work"/prefix/share/rondo/cases/*.toml "$work"/prefix/share/rondo/cases/studies/*.toml; do
  named=$(head -n 1 "$file")
  test -f "$(dirname "$file")/${named#"#:schema "}" # its schema, relative to itself
done
{ # the block of C++ of docs/library.md, as a program
  printf '#include <rondo/%s.hpp>\n' analysis/build/build case/case integrators/integrator integrators/start
  printf '#include <vector>\nint main() {\n'
  sed -n '/^```cpp$/,/^```$/{/^```/!p}' "$source/docs/library.md"
  printf 'return reports.back().balance.relative < 1e-12 ? 0 : 1;\n}\n'
} >"$work/page.cpp"
include=$work/prefix/include
alone=() # headers that no source of the library includes before all others
for header in $(cd "$include" && find rondo -name '*.hpp'); do
  source_of=$source/src/${header%.hpp}.cpp
  [ -f "$source_of" ] && [ "$(grep -m 1 '^#include' "$source_of")" = "#include \"$header\"" ] || alone+=("$header")
  for included in $(sed -n 's/^#include "\(.*\)"$/\1/p' "$include/$header"); do
    test -f "$include/$included" || {
      echo "$header includes $included, which is not installed"
      exit 1
    }
  done
done
echo "headers compiled alone: ${alone[*]}"
cmake -S "$source/tests/house/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE="$build_type" \
  -DCMAKE_PREFIX_PATH="$work/prefix" -DRONDO_INCLUDE="$include" -DRONDO_ALONE="$(IFS=';' && echo "${alone[*]}")" \
  -DRONDO_PAGE="$work/page.cpp" -DRONDO_MATERIAL="$source/examples/own_material.cpp" >/dev/null
cmake --build "$work/build"
cases=$work/prefix/share/rondo/cases
RONDO_MESH_READER="$work/prefix/bin/rondo-mesh-reader" \
  "$work/build/consumer" "$cases/meshes/block.msh" "$cases/rolling-flat.toml" "$work/results"
cp "$cases/rolling-flat.toml" "$work/case.toml"
(cd "$work" && build/page)
"$work/build/own_material"
for header in $(sed -n '/PUBLIC_HEADERS/,/)/p' "$source/cmake/public_headers.cmake" | grep -o '[a-z/_]*\.hpp'); do
  grep -qF "rondo/$header" "$source/docs/library.md" || {
    echo "docs/library.md does not name rondo/$header"
    exit 1
  }
done

package=$(cd "$work/prefix" && echo lib/python3*/dist-packages)
test -z "$(find "$work/prefix" -name __pycache__)"
test -f "$work/prefix/$package/rondo/py.typed"
test -f "$work/prefix/$package/rondo/_core.pyi"
for file in "$work"/prefix/bin/* "$work/prefix/$package"/rondo/_core*.so; do
  if readelf -d "$file" | grep -E 'R(UN)?PATH' | grep -F -e "$build" -e "$source"; then
    echo "$file looks for libraries in the build"
    exit 1
  fi
done

module=$(sed -n 's/^RONDO_PYTHON_MODULE:INTERNAL=//p' "$build/CMakeCache.txt")
reason=$(sed -n 's/^RONDO_PYTHON_MODULE_MISSING:INTERNAL=//p' "$build/CMakeCache.txt")
mv "$work/prefix" "$work/moved"
cd "$work" # not the sources: nothing else is to be found
env -i PATH=/usr/bin HOME="$work" PYTHONPATH="$work/moved/$package" PYTHONDONTWRITEBYTECODE=1 \
  MPLBACKEND=Agg /usr/bin/python3 "$source/tests/house/use_package.py" "$work/moved" "$module" "$reason"
