# Puts the program built in build/release, and the Python package, on the paths of this shell:
#   source scripts/env.sh         bash or zsh, from any folder
# PATH gets build/release, PYTHONPATH gets python, both absolute; sourced again it changes nothing.
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
  echo "env: $(command -v python3 || echo 'no python3') lacks: $_rondo_missing. The packages of" \
    "scripts/setup.sh are those of the system's Python: alias python3=/usr/bin/python3" >&2
fi
unset _rondo_root _rondo_missing
