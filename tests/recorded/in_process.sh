#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Whether the solver in process answers as the daemon does, to the last bit: both are asked the same set of
# questions (record.sh), from Python and from the command line, and the differences are shown.
# usage: in_process.sh [SOURCE [BUILD]]    exit 1: they differ
# environment: PERCUSS_SCENES=300: how many random scenes
set -eu
here=$(cd "$(dirname "$0")" && pwd)
PERCUSS_SOURCE=${1:-$here/../..}
PERCUSS_BUILD=${2:-$PERCUSS_SOURCE/build}
export PERCUSS_SOURCE PERCUSS_BUILD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/scenes"
"$PERCUSS_BUILD/tests/save_scenes" 1 "${PERCUSS_SCENES:-300}" "$work/scenes"
sh "$here/record.sh" "$work/scenes" "$work/by_daemon"
PERCUSS_IN_PROCESS=1 sh "$here/record.sh" "$work/scenes" "$work/by_itself"
if cmp -s "$work/by_daemon" "$work/by_itself"; then
    echo "the same bytes"
else
    diff "$work/by_daemon" "$work/by_itself" | cut -c 1-300 | head -n 40
    echo "they differ"
    exit 1
fi
