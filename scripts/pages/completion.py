# SPDX-License-Identifier: BSD-3-Clause
"""The completion of bash: commands, their options, the values that are known, case files, directories,
and the keys of --set with their values. It needs nothing but bash: neither bash-completion nor the
program, whose tables are in it."""
from __future__ import annotations

import re
from typing import Any

from help_text import Entry, Help
from manual import case_keys

HEAD = """# SPDX-License-Identifier: BSD-3-Clause
# Completion of rondo in bash, written from its --help: do not edit (scripts/pages).
"""

BODY = r"""
_rondo_files() { # PATTERN, "" for any: files of that name, and directories
  local IFS=$'\n'
  compopt -o filenames 2>/dev/null
  COMPREPLY+=($(compgen -d -- "$cur"))
  if [ "$1" = / ]; then return; fi
  local file
  while read -r file; do
    [ -d "$file" ] || [[ -n $1 && $file != *$1 ]] || COMPREPLY+=("$file")
  done < <(compgen -f -- "$cur")
}

_rondo_settings() { # of --set: KEY, or the value after KEY=
  if [ -n "$key" ]; then
    COMPREPLY=($(compgen -W "$(_rondo_key_values "$key")" -- "$cur"))
  else
    compopt -o nospace 2>/dev/null
    COMPREPLY=($(compgen -W "$_rondo_keys" -S = -- "$cur"))
  fi
}

_rondo_take() { # KIND: what an option or an argument takes
  case $1 in
    set) _rondo_settings ;;
    directory) _rondo_files / ;;
    file) _rondo_files "" ;;
    .*) _rondo_files "$1" ;;
    number) ;;
    *) COMPREPLY=($(compgen -W "$1" -- "$cur")) ;;
  esac
}

_rondo() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} key=""
  local at=$COMP_CWORD
  COMPREPLY=()
  # bash takes `=` for a word: --set KEY = VALUE, or --option = VALUE
  if [ "$cur" = = ]; then cur=""; at=$((at + 1)); fi
  if [ "$at" -ge 3 ] && [ "${COMP_WORDS[at-1]}" = = ]; then
    before=${COMP_WORDS[at-2]}
    if [ "$at" -ge 4 ] && [ "${COMP_WORDS[at-3]}" = --set ]; then key=$before before=--set; fi
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$_rondo_commands $(_rondo_options "")" -- "$cur"))
    return
  fi
  local kind
  kind=$(_rondo_value_of "$command" "$before")
  if [ -n "$kind" ]; then
    _rondo_take "$kind"
  elif [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$(_rondo_options "$command")" -- "$cur"))
  else
    _rondo_take "$(_rondo_argument "$command")"
  fi
}
complete -F _rondo rondo
"""


def kind(entry: Entry) -> str:
    """What _rondo_take knows: a word of its own, or the values that there are."""
    if "--set" in entry.names:
        return "set"
    if entry.choices:
        return " ".join(entry.choices)
    if entry.value in ("integer", "number"):
        return "number"
    if "TOML" in entry.meaning:
        return ".toml"
    head = entry.meaning.split(";")[0].split(",")[0]
    if "director" in head.lower():
        return "directory"
    plain = entry.default or re.search(r", [^\s()]+[:/][^\s()]", entry.meaning)  # 2GB, FROM:TO:NUMBER, i/n
    return "number" if plain or entry.value != "text" else "file"


def _case(name: str, rows: list[tuple[str, str]]) -> str:
    lines = [f"    {pattern}) echo '{text}' ;;" for pattern, text in rows if text]
    return "\n".join([f"{name}() {{", "  case $1 in", *lines, "  esac", "}"])


def _values(commands: dict[str, Help]) -> str:
    rows = []
    for name, text in commands.items():
        for option in text.options:
            if option.value:
                rows.append(("|".join(f"{name}/{one}" for one in option.names), kind(option)))
    return _case("_rondo_value_of", rows).replace("case $1 in", "case $1/$2 in")


def _key_values(schema: dict[str, Any]) -> list[tuple[str, str]]:
    rows = []
    for key, value in case_keys(schema):
        words = ["true", "false"] if value.get("type") == "boolean" else value.get("enum", [])
        rows.append((key.replace("[]", r"\[*\]"), " ".join(str(word) for word in words)))
    return rows


def script(top: Help, commands: dict[str, Help], schema: dict[str, Any]) -> str:
    def names(options: list[Entry]) -> str:
        return " ".join(name for option in options for name in option.names)

    keys = " ".join(key.replace("[]", "[0]") for key, _ in case_keys(schema))
    options = [('""', names(top.options))] + [(name, names(text.options)) for name, text in commands.items()]
    arguments = [(name, kind(text.arguments[0])) for name, text in commands.items() if text.arguments]
    parts = [f"_rondo_commands='{' '.join(commands)}'", f"_rondo_keys='{keys}'",
             _case("_rondo_options", options), _case("_rondo_argument", arguments),
             _values(commands), _case("_rondo_key_values", _key_values(schema))]
    return HEAD + "\n".join(parts) + "\n" + BODY
