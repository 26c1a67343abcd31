#!/usr/bin/env bash
# Installs what rondo needs to build, run and test, from Debian packages (Debian 12 or later).
# Works as root, or with sudo. Installs only what is missing.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache git       # build
  libeigen3-dev libsuitesparse-dev libspectra-dev    # linear algebra, sparse Cholesky, eigenvalues
  libopenblas-dev liblapacke-dev libfftw3-dev        # singular values, QR; Fourier transforms
  libhdf5-dev nlohmann-json3-dev libtomlplusplus-dev libxxhash-dev # files
  libgmsh-dev gmsh                                   # meshes from files; gmsh makes cases/meshes
  libopenmpi-dev openmpi-bin                         # sweeps on clusters
  libcli11-dev libfmt-dev libspdlog-dev              # command line, text, log
  libgtest-dev clang-format clang-tidy cppcheck      # tests
  clang libclang-rt-14-dev llvm-14 libomp-dev        # the other compiler, sanitizers, scripts/fuzz.sh
  gcovr                                              # scripts/coverage.sh
  libbenchmark-dev valgrind                          # bench/; instructions of a step, a test
  python3 python3-numpy python3-h5py python3-matplotlib python3-pil # pictures; a second reader of the results
  ffmpeg                                             # films (.mp4)
  python3-pytest mypy python3-pip python3-venv       # tests of the Python package
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
echo "setup: done"
