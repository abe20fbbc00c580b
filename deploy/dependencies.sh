#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what percuss is built with and tested with, from Debian 12; nothing where it is there
# already. Needs root (or sudo) only when something is missing.
# usage: dependencies.sh [build|test|mpi|package|ci|peers]    (mpi: what percuss-reduce-mpi needs; package: what makes
# Debian packages; ci: all of these, a second compiler and what makes an empty machine; peers: the programs of
# tests/bench/peers.sh)
set -eu

build="gcc cmake make pkg-config cyclonedds-dev cyclonedds-tools libsundials-dev libopenblas-serial-dev
liblapacke-dev libyaml-dev libjansson-dev libcminpack-dev gnuplot-nox librandom123-dev libsqlite3-dev
libmumps-seq-dev libhdf5-dev libssl-dev libjs-dygraphs"
test="libcmocka-dev python3-venv libmujoco-dev valgrind openssl iproute2 mount gmsh calculix-ccx
python3-prometheus-client libudunits2-dev python3-jsonschema python3-yaml zsh fish
python3-sphinx python3-myst-parser g++ libfastrtps-dev fastddsgen poppler-utils chromium
dwarves doxygen"
mpi="libslepc-real-dev mpi-default-dev mpi-default-bin"
package="dpkg-dev file"
peers="g++ python3-venv calculix-ccx libsimbody-dev libsiconos-kernel-dev"
ci="clang clang-tidy libclang-rt-14-dev mmdebstrap lintian"

case ${1:-build} in
build) packages=$build ;;
test) packages="$build $test" ;;
ci) packages="$build $test $mpi $package $ci" ;;
package) packages="$build $package" ;;
mpi) packages="$build $mpi" ;;
peers) packages="$build $peers" ;;
*)
    echo "usage: dependencies.sh [build|test|mpi|package|ci|peers]" >&2
    exit 2
    ;;
esac

missing=""
for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
        missing="$missing $package"
done
[ -n "$missing" ] || exit 0

command -v apt-get >/dev/null || {
    echo "dependencies: this script knows Debian's apt-get only; install:$missing" >&2
    exit 1
}
# without root: by sudo, or the line for somebody who may
sudo=""
refuse() {
    echo "dependencies: $1; ask the administrator of this machine to run, as root:" >&2
    echo "  apt-get install --no-install-recommends$missing" >&2
    exit 1
}
if [ "$(id -u)" -ne 0 ]; then
    sudo=sudo
    command -v sudo >/dev/null || refuse "packages are missing, and there is no sudo"
    # not sudo -v: it may be allowed no more than this
    sudo apt-get --version >/dev/null || refuse "packages are missing, and sudo refuses"
fi
echo "installing:$missing" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
for attempt in 1 2 3; do
    if { $sudo apt-get update && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y \
        --no-install-recommends $missing; } >"$log" 2>&1; then
        exit 0
    fi
    sleep $((attempt * 5))
done
tail -n 20 "$log" >&2
echo "dependencies: could not install:$missing" >&2
exit 1
