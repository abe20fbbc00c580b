#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Mirrors layers.sh: what it is there to refuse it refuses, and names it; the tree as it is passes.
# usage: layers_test.sh SOURCE_DIR
set -eu
source=${1:?"usage: layers_test.sh SOURCE_DIR"}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# includes FILE HEADER: one more line
includes() {
    echo "#include \"$2\"" >>"$work/$1"
}

# refused WORDS: the tree is, with these in what is said; then it is as it was
refused() {
    ! sh "$here/layers.sh" "$work" >/dev/null 2>"$work/said" || { echo "passes: $1" >&2 && exit 1; }
    grep -qF "$1" "$work/said" || { cat "$work/said" >&2 && exit 1; }
    rm -rf "$work/service" "$work/client"
    as_it_is
}

as_it_is() {
    mkdir -p "$work/client"
    cp -R "$source/service" "$work"
    for folder in cli include lib measured slowscale twins; do cp -R "$source/client/$folder" "$work/client"; done
}

as_it_is
sh "$here/layers.sh" "$work" >/dev/null

# header to header, source to header and back, and the long way round over three
includes service/core/numeric/made_up.h numeric/made_too.h
includes service/core/numeric/made_too.h numeric/made_up.h
refused "numeric/made_up > numeric/made_too > numeric/made_up"
includes service/core/base/made_up.c base/made_too.h
includes service/core/base/made_too.h base/made_up.h
refused "base/made_up > base/made_too > base/made_up"
includes client/cli/made_up.h made_too.h
includes client/cli/made_too.c made_three.h
includes client/cli/made_three.h made_up.h
refused "client/cli/made_three > client/cli/made_up > client/cli/made_too > client/cli/made_three"

# upward, out of the service, and a library of another folder's
includes service/core/base/made_up.c solve/solve.h
refused "service/core/base/made_up.c (base) includes solve/solve.h"
includes client/cli/made_up.c solve/solve.h
refused "client looks into the service"
includes client/measured/made_up.c base/fault.h
refused "client looks into the service"
echo '#include <sqlite3.h>' >>"$work/service/core/solve/made_up.c"
refused "<sqlite3> outside service/store"
echo '#include <zmumps_c.h>' >>"$work/service/tools/reduce/made_up.c"
refused "<zmumps> outside tests/reference/spatial"
echo "layers_test: passed"
