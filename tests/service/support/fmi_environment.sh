#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Makes the virtual environment in which FMUs are tried: FMPy, which simulates and checks them, and CasADi.
# usage: fmi_environment.sh VENV_DIR; exit code 77, with the reason: there is nothing to test with.
set -eu
venv=$1
log=$venv.log
packages="fmpy==0.3.32 casadi==3.8.2"
export PIP_DISABLE_PIP_VERSION_CHECK=1

skip() {
    echo "skipped: $*" >&2
    exit 77
}

# try SECONDS COMMAND...: three times, since a package index may be away for a moment
try() {
    seconds=$1
    shift
    for pause in 5 15 0; do
        timeout "$seconds" "$@" >"$log" 2>&1 && return
        sleep "$pause"
    done
    return 1
}

wanted="$(python3 --version) $packages"
[ "$(cat "$venv/wanted" 2>/dev/null)" != "$wanted" ] || exit 0
rm -rf "$venv"
command -v python3 >/dev/null || skip "no python3"
python3 -m venv "$venv" >"$log" 2>&1 || skip "python3 -m venv does not work (Debian: python3-venv): $(tail -n 1 "$log")"
# a small package tells a machine without a package index from packages that do not install
try 60 "$venv/bin/pip" install --retries 1 attrs || skip "pip reaches no package index: $(grep -i error "$log" | tail -n 1)"
# shellcheck disable=SC2086 # words
try 240 "$venv/bin/pip" install --no-compile $packages || {
    cat "$log" >&2
    exit 1
}
echo "$wanted" >"$venv/wanted"
