#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Makes the virtual environment of the Python tests and installs the package into it, as a user would.
# usage: environment.sh SOURCE_DIR VENV_DIR; exit code 77, with the reason: there is nothing to test with.
set -eu
package=$1/client/python
venv=$2
log=$venv.log
extras="mujoco,dds,http,plot,pandas,dask,wheel,test"
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

# a changed list of dependencies or another Python starts anew
wanted=$( (python3 --version && echo "$extras" && cat "$package/pyproject.toml") | cksum)
if [ "$(cat "$venv/wanted" 2>/dev/null)" != "$wanted" ]; then
    rm -rf "$venv"
    command -v python3 >/dev/null || skip "no python3"
    python3 -m venv "$venv" >"$log" 2>&1 || skip "python3 -m venv does not work (Debian: python3-venv): $(tail -n 1 "$log")"
    # a small package tells a machine without a package index from dependencies that do not install
    try 60 "$venv/bin/pip" install --retries 1 "flit_core >=3.4,<4" ||
        skip "pip reaches no package index: $(grep -i error "$log" | tail -n 1)"
    try 240 "$venv/bin/pip" install --no-compile "$package[$extras]" || {
        cat "$log" >&2
        exit 1
    }
    echo "$wanted" >"$venv/wanted"
else
    # the package itself may have changed; everything else is there
    "$venv/bin/pip" install --no-index --no-deps --no-build-isolation --force-reinstall "$package" >"$log" 2>&1 || {
        cat "$log" >&2
        exit 1
    }
fi
"$venv/bin/pip" list
