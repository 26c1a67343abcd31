# SPDX-License-Identifier: BSD-3-Clause
# Puts the program built in build/release, and the Python package, on the paths of this shell:
#   source scripts/env.sh         bash or zsh, from any folder
# PATH gets build/release, PYTHONPATH gets python, both absolute; sourced again it changes nothing.
# A bash that is typed in completes rondo's commands, options and keys.
# To be sourced, not run: what a script sets ends with it.
if [ -n "${BASH_VERSION:-}" ]; then
  _rondo_root=${BASH_SOURCE[0]}
elif [ -n "${ZSH_VERSION:-}" ]; then
  eval '_rondo_root=${(%):-%x}' # other shells cannot read it
else
  _rondo_root=scripts/env.sh # no way to know: from the root of the project
fi
_rondo_root=$(CDPATH='' cd -- "$(dirname -- "$_rondo_root")/.." && pwd)

if [ -n "${BASH_VERSION:-}" ] && [ "${BASH_SOURCE[0]}" = "$0" ]; then
  echo "env: nothing is set by running this file: source scripts/env.sh" >&2
fi
case ":$PATH:" in
  *":$_rondo_root/build/release:"*) ;;
  *) export PATH="$_rondo_root/build/release:$PATH" ;;
esac
case ":${PYTHONPATH:-}:" in
  *":$_rondo_root/python:"*) ;;
  *) export PYTHONPATH="$_rondo_root/python${PYTHONPATH:+:$PYTHONPATH}" ;;
esac

if [ ! -x "$_rondo_root/build/release/rondo" ]; then
  echo "env: build/release/rondo is not built yet: bash scripts/demo.sh builds it" >&2
fi
_rondo_missing='import importlib.util as u; print(*[m for m in ("numpy", "h5py", "matplotlib")
  if u.find_spec(m) is None])'
_rondo_missing=$(python3 -c "$_rondo_missing" 2>&1) || true
if [ -n "$_rondo_missing" ]; then
  echo "env: $(command -v python3 || echo 'no python3') lacks: $_rondo_missing. Commands of rondo do without it;" \
    "run scripts that import rondo with /usr/bin/python3, which has the packages of scripts/setup.sh" >&2
fi
case ${BASH_VERSION:+$-} in
  *i*)
    if [ -x "$_rondo_root/build/release/rondo" ]; then
      # Written anew by each new program.
      if [ "$_rondo_root/build/release/completions/rondo" -ot "$_rondo_root/build/release/rondo" ]; then
        /usr/bin/python3 -B "$_rondo_root/scripts/pages/write.py" "$_rondo_root/build/release/rondo" \
          --bash "$_rondo_root/build/release/completions/rondo" >/dev/null 2>&1 || true
      fi
      . "$_rondo_root/build/release/completions/rondo" 2>/dev/null || true
    fi
    ;;
esac
unset _rondo_root _rondo_missing
