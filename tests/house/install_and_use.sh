#!/usr/bin/env bash
# Installs the build into a folder of its own, builds another program against it and runs both; imports
# the Python package from there. The headers are those of the list, and each stands by itself.
set -euo pipefail
build=$1 source=$2 build_type=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
"$work/prefix/bin/rondo" --version
test -x "$work/prefix/bin/rondo-mesh-reader"
test -f "$work/prefix/share/rondo/cases/ledge-smooth.toml"
cmake -S "$source/tests/house/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE="$build_type" \
  -DCMAKE_PREFIX_PATH="$work/prefix" -DRONDO_INCLUDE="$work/prefix/include" >/dev/null
cmake --build "$work/build"
cases=$work/prefix/share/rondo/cases
RONDO_MESH_READER="$work/prefix/bin/rondo-mesh-reader" \
  "$work/build/consumer" "$cases/meshes/block.msh" "$cases/rolling-flat.toml" "$work/results"
for header in $(sed -n '/PUBLIC_HEADERS/,/)/p' "$source/cmake/public_headers.cmake" | grep -o '[a-z/_]*\.hpp'); do
  grep -qF "rondo/$header" "$source/docs/library.md" || {
    echo "docs/library.md does not name rondo/$header"
    exit 1
  }
done

package=$(cd "$work/prefix" && echo lib/python3*/dist-packages)
test -z "$(find "$work/prefix" -name __pycache__)"
cd "$work" # not the sources: nothing else is to be found
PYTHONPATH="$work/prefix/$package" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "$work/prefix" <<'EOT'
import subprocess
import sys

import rondo
import rondo.figures.run_figures  # the folders below are there too

prefix = sys.argv[1]
assert rondo.__file__.startswith(prefix), rondo.__file__
said = subprocess.run([f"{prefix}/bin/rondo", "--version"], capture_output=True, text=True).stdout
assert said.split()[:2] == ["rondo", rondo.__version__], said
print("rondo", rondo.__version__, "for Python")
EOT
