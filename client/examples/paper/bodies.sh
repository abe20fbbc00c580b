#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The paper's half-circular plates, as config/bodies holds them: meshes by Gmsh, reduced to their modes.
# usage: bodies.sh [BUILD [FOLDER]]    (default: build/ and config/bodies of this source tree)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../../.." && pwd)
build=${1:-$source/build}
folder=${2:-$source/config/bodies}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# radius, thickness (mm), frequency (Hz): three times what the contact's shortest duration asks for
plate() {
    gmsh "$here/half_plate.geo" -3 -setnumber R "$1" -setnumber T "$2" -o "$work/half-plate-$2.msh" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
    "$build/bin/percuss-reduce" "$work/half-plate-$2.msh" --unit mm --catalogue "$source/config/catalogue.yaml" \
        --material aluminium --max-frequency "$3" --site 0,0,0 -o "$folder/half-plate-$2.h5"
}

plate 100 20 40000
plate 141.421 10 40000
