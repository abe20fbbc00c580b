# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# For the scripts that set programs of an older release beside today's: sourced with here (the folder of tests), release,
# revision (its commit) and OLD as the first argument, a source tree that is already built, or none. Sets then and today,
# the folders of both's programs, and the stories' functions. Exit code 77: the history is not here.
# shellcheck shell=sh
kept=${1:-}
old=${kept:-$(mktemp -d)}

if [ ! -x "$old/build/bin/percussd" ]; then
    cd "$here/.."
    git rev-parse --quiet --verify "$revision^{commit}" >/dev/null 2>&1 || {
        echo "$(basename "$0" .sh): NOT TRIED: the history of $release ($revision) is not here" >&2
        exit 77
    }
    mkdir -p "$old"
    git archive "$revision" | tar -x -C "$old"
    { cmake -S "$old" -B "$old/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
        ${CMAKE_C_COMPILER_LAUNCHER:+"-DCMAKE_C_COMPILER_LAUNCHER=$CMAKE_C_COMPILER_LAUNCHER"} &&
        cmake --build "$old/build" --parallel "$(nproc)" --target percussd percuss; } >"$old/log" 2>&1 || {
        tail -n 30 "$old/log" >&2
        exit 1
    }
fi

PERCUSS_SOURCE=$here/..
# shellcheck source=tests/service/support/lib.sh
. "$here/service/support/lib.sh"
[ -n "$kept" ] || trap 'cleanup; rm -rf "$old"' EXIT
today=$bin
then=$old/build/bin
