#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The FMU of an impact: by gap and rate, by poses, by the simulator's own mass, in process and by a daemon.
. "$(dirname "$0")/../support/lib.sh"

venv=$build/fmi-venv
[ -e "$venv/wanted" ] || {
    echo "skipped: no virtual environment; see the test service/clients/fmi_environment" >&2
    exit 77
}
export TMPDIR="$work" PYTHONPATH="$support" PYTHONDONTWRITEBYTECODE=1
fmu=$build/client/fmi/percuss_impact_law.fmu
start_daemon
expect 0 "$venv/bin/fmpy" validate "$fmu"
shows "No problems found."
expect 0 "$venv/bin/python" "$support/fmi_impact_law.py" "$fmu" "$bin/percuss" \
    "$build/client/libpercuss.so" "$domain"
shows "e = 0.1662"
stop_daemon
