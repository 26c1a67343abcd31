#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs Debian packages (Debian 12 or later), as root or with sudo, and only what is missing.
#   bash scripts/setup.sh          what building and running rondo needs, and pip install ./python
#   bash scripts/setup.sh --dev    tests, lint, sanitizers, fuzzing, coverage and benchmarks too; Chromium,
#                                  which tests pages, and Taplo, which tests the schemas for editors
#   bash scripts/setup.sh --docs   what scripts/docs.sh needs, and nothing else
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache git       # build
  libeigen3-dev libsuitesparse-dev libspectra-dev    # linear algebra, sparse Cholesky, eigenvalues
  libopenblas-dev liblapacke-dev libfftw3-dev        # singular values, QR; Fourier transforms
  libhdf5-dev nlohmann-json3-dev libtomlplusplus-dev libxxhash-dev libminizip-dev # files
  libgmsh-dev                                        # meshes from files
  libopenmpi-dev openmpi-bin                         # sweeps on clusters
  libcli11-dev libfmt-dev libspdlog-dev              # command line, text, log
  pybind11-dev python3-dev                           # the library in Python: rondo._core
  python3 python3-numpy python3-h5py python3-matplotlib python3-pil # pictures
  ffmpeg                                             # films (.mp4)
  file                                               # packages for Debian
)
for_site=(
  python3 mkdocs mkdocs-material python3-pymdownx python3-yaml # pages
  libjs-katex fonts-katex                            # equations
)
for_development=(
  libgtest-dev python3-pytest python3-pip python3-venv patch python3-jsonschema # tests
  python3-yaml man-db mandoc libxml2-utils           # tests: the citation, pages of man, XML of FMUs
  python3-pandas python3-xarray python3-scipy        # what results, matrices and fits may use, optional
  gmsh                                               # makes cases/meshes and tests/meshes
  clang-format clang-tidy cppcheck mypy reuse        # scripts/lint.sh; mypy: tests/python too
  clang libclang-rt-14-dev llvm-14 libomp-dev        # the other compiler, sanitizers, scripts/fuzz.sh
  gcovr                                              # scripts/coverage.sh
  libbenchmark-dev valgrind                          # bench/; instructions of a step, a test
  "${for_site[@]}" python3-markdown-it               # scripts/docs.sh; its pages against a second reader
  chromium chromium-driver python3-selenium          # the site and reports in a browser
)
with_plotly=1
with_taplo=
case ${1:-} in
  '') ;;
  --dev) packages+=("${for_development[@]}"); with_taplo=1 ;;
  --docs) packages=("${for_site[@]}"); with_plotly= ;;
  *) sed -n '3,7s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
# It comes with Node.js, too, which need not be Debian's.
if [ -n "$with_plotly" ] && ! command -v npm >/dev/null; then packages+=(npm); fi

installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "$package installed" <<<"$installed" || missing+=("$package")
done
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null && as_root=(sudo)
fi

# Taplo's command line and language server are npm's: without npm their tests say that they are skipped.
install_taplo() {
  local wanted=(@taplo/cli@0.7.0 @taplo/lsp@0.8.0)
  command -v npm >/dev/null || { echo "setup: no npm: tests with Taplo will be skipped"; return; }
  local there
  there=$(npm ls -g 2>/dev/null || true)
  for package in "${wanted[@]}"; do
    [[ $there == *"$package"* ]] && continue
    "${as_root[@]}" npm install -g --silent "${wanted[@]}" ||
      echo "setup: npm has not installed ${wanted[*]}: tests with Taplo will be skipped" >&2
    return
  done
}

# What draws the curves of rondo report; it goes into the page, which then asks no network for it.
install_plotly() {
  local wanted=plotly.js-basic-dist-min@4.1.1 there
  there=$(npm ls -g 2>/dev/null || true)
  [[ $there == *"$wanted"* ]] && return
  "${as_root[@]}" npm install -g --silent "$wanted" ||
    echo "setup: npm has not installed $wanted: rondo report will refuse, all else works" >&2
}

if [ ${#missing[@]} -gt 0 ]; then
  if [ "$(id -u)" -ne 0 ] && [ ${#as_root[@]} -eq 0 ]; then
    echo "setup: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2
    exit 1
  fi
  echo "setup: installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"
  echo "setup: done"
else
  echo "setup: all ${#packages[@]} packages are installed"
fi
if [ -n "$with_plotly" ]; then install_plotly; fi
if [ -n "$with_taplo" ]; then install_taplo; fi
