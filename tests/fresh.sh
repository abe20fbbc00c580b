#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# README followed from nothing: empty Debian 12 roots, each with a clean clone of HEAD, this machine's
# apt and pip configuration, and nothing else of it. Takes a quarter of an hour and 5 GB for that time.
# usage: fresh.sh [STAGE...]    (quickstart, tests, packages, systemd, sanitize, newcomer; default: the first three;
# newcomer needs a build in build/)
# Exit code 77: this machine does not let it, and the reason is said.
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- quickstart tests packages
for stage; do
    case $stage in
    quickstart | tests | packages | systemd | sanitize | newcomer) ;;
    *)
        echo "usage: fresh.sh [quickstart|tests|packages|systemd|sanitize|newcomer]..." >&2
        exit 2
        ;;
    esac
done

cannot() {
    echo "fresh: NOT TRIED on an empty machine: $*" >&2
    exit 77
}
[ "$(id -u)" -eq 0 ] || cannot "it takes root"
command -v mmdebstrap >/dev/null || cannot "mmdebstrap is not installed (sh deploy/dependencies.sh ci)"
git rev-parse --verify --quiet HEAD >/dev/null || cannot "this is no git repository"
unshare --mount --pid --fork true 2>/dev/null || cannot "no mounts of its own are allowed here"

# mounts and processes are those of namespaces: they end with it, however it ends
work=$(mktemp -d "${TMPDIR:-/var/tmp}/percuss-fresh.XXXXXX")
child=
cleanup() {
    [ -z "$child" ] || kill -KILL "$child" 2>/dev/null || true
    wait
    rm -rf --one-file-system "$work"
}
trap cleanup EXIT
trap 'exit 1' INT TERM
unshare --mount --pid --fork --kill-child sh tests/fresh/stages.sh "$work" "$@" &
child=$!
code=0
wait "$child" || code=$?
child=
exit "$code"
