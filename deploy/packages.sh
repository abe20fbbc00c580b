#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Debian packages of this tree (cmake/percuss_packages.cmake), for the Debian it runs on.
# usage: packages.sh FOLDER [RELEASE]    where they go; the part of their version after "-" (1)
set -eu
[ $# -ge 1 ] || {
    echo "usage: packages.sh FOLDER [RELEASE]" >&2
    exit 2
}
mkdir -p "$1"
folder=$(cd "$1" && pwd)
release=${2:-1}
cd "$(dirname "$0")/.."
sh deploy/dependencies.sh package

# /usr, as paths of the installed tree are compiled in; Debian's linker finds the library by itself
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
umask 022
{
    cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/usr \
        -DCMAKE_SKIP_INSTALL_RPATH=ON -DPERCUSS_PACKAGES=ON \
        ${CMAKE_C_COMPILER_LAUNCHER:+"-DCMAKE_C_COMPILER_LAUNCHER=$CMAKE_C_COMPILER_LAUNCHER"} &&
        cmake --build "$build" --parallel "$(nproc)" &&
        cd "$build" && cpack -D "CPACK_DEBIAN_PACKAGE_RELEASE=$release" -B "$folder"
} >"$folder/log" 2>&1 || {
    tail -n 30 "$folder/log" >&2
    exit 1
}
rm -rf "$folder/_CPack_Packages" "$folder/log"
ls "$folder"/*.deb
