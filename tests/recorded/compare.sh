#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Whether this tree's build answers as another build does, to the last bit: both are asked the same set of
# questions (record.sh) on this machine, and the differences are shown.
# usage: compare.sh OTHER_SOURCE OTHER_BUILD [SOURCE [BUILD]]    exit 1: they differ
# environment: PERCUSS_SCENES=300: how many random scenes
set -eu
here=$(cd "$(dirname "$0")" && pwd)
other_source=$1
other_build=$2
source=${3:-$here/../..}
build=${4:-$source/build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/scenes"
"$build/tests/save_scenes" 1 "${PERCUSS_SCENES:-300}" "$work/scenes"
PERCUSS_SOURCE=$other_source PERCUSS_BUILD=$other_build sh "$here/record.sh" "$work/scenes" "$work/other"
PERCUSS_SOURCE=$source PERCUSS_BUILD=$build sh "$here/record.sh" "$work/scenes" "$work/this"
if cmp -s "$work/other" "$work/this"; then
    echo "the same bytes"
else
    diff "$work/other" "$work/this" | cut -c 1-300 | head -n 40
    echo "they differ"
    exit 1
fi
