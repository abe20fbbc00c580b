# shellcheck shell=sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Every CPython that is found, on the PATH and of pyenv. For interpreters.sh and wheel.sh.

# found: "MINOR PROGRAM" a line, each version of CPython 3 once
found() {
    for program in $(command -v python3 || true) $(IFS=: && for folder in $PATH; do ls "$folder"/python3.*; done 2>/dev/null) \
        "${PYENV_ROOT:-$HOME/.pyenv}"/versions/*/bin/python3; do
        # a script of pyenv's in a version's place fails; so does a python3.11-config
        "$program" -c 'import sys, venv, ensurepip
sys.implementation.name == "cpython" and print(sys.version_info[1], sys.argv[1])' "$program" 2>/dev/null || continue
    done | sort -n -u -k 1,1
}
