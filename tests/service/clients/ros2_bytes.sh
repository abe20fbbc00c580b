#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The bytes of the messages beside those of rosbags (PyPI), in an environment of its own.
# In PERCUSS_BUILD, of PERCUSS_SOURCE; exit code 77, with the reason: there is nothing to test with.
set -eu
venv=$PERCUSS_BUILD/ros2-venv
export PIP_DISABLE_PIP_VERSION_CHECK=1
if [ ! -e "$venv/whole" ]; then
    rm -rf "$venv"
    python3 -m venv "$venv" || { echo "skipped: python3 -m venv does not work (Debian: python3-venv)" && exit 77; }
    for pause in 5 15 0; do
        ! timeout 120 "$venv/bin/pip" install -q --no-compile "rosbags >=0.11,<0.12" || break
        sleep "$pause"
    done
    "$venv/bin/python" -c "import rosbags" || { echo "skipped: pip reaches no package index" && exit 77; }
    : >"$venv/whole"
fi
"$venv/bin/python" "$PERCUSS_SOURCE/tests/service/support/ros2_bytes.py" "$PERCUSS_SOURCE/client/ros2/percuss_msgs" \
    "$PERCUSS_BUILD/tests/service/ros2_bytes"
