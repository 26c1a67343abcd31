#!/usr/bin/env bash
# Installs Debian packages (Debian 12 or later), as root or with sudo, and only what is missing.
#   bash scripts/setup.sh          what building and running rondo needs
#   bash scripts/setup.sh --dev    tests, lint, sanitizers, fuzzing, coverage and benchmarks too
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache git       # build
  libeigen3-dev libsuitesparse-dev libspectra-dev    # linear algebra, sparse Cholesky, eigenvalues
  libopenblas-dev liblapacke-dev libfftw3-dev        # singular values, QR; Fourier transforms
  libhdf5-dev nlohmann-json3-dev libtomlplusplus-dev libxxhash-dev # files
  libgmsh-dev                                        # meshes from files
  libopenmpi-dev openmpi-bin                         # sweeps on clusters
  libcli11-dev libfmt-dev libspdlog-dev              # command line, text, log
  python3 python3-numpy python3-h5py python3-matplotlib python3-pil # pictures
  ffmpeg                                             # films (.mp4)
)
for_development=(
  libgtest-dev python3-pytest python3-pip python3-venv patch # tests
  gmsh                                               # makes cases/meshes and tests/meshes
  clang-format clang-tidy cppcheck mypy              # scripts/lint.sh
  clang libclang-rt-14-dev llvm-14 libomp-dev        # the other compiler, sanitizers, scripts/fuzz.sh
  gcovr                                              # scripts/coverage.sh
  libbenchmark-dev valgrind                          # bench/; instructions of a step, a test
)
case ${1:-} in
  '') ;;
  --dev) packages+=("${for_development[@]}") ;;
  *) sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac

installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "$package installed" <<<"$installed" || missing+=("$package")
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
