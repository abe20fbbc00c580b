#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Installs a build into an empty prefix and builds the example against it, once through the CMake
# package and once through pkg-config, as a stranger would. Usage: install_example.sh BUILD [DOMAIN];
# with a domain in which a percussd runs, both programs are run as well.
set -eu
build=${1:?"usage: install_example.sh BUILD [DOMAIN]"}
domain=${2:-}
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
example=$work/example

cmake --install "$build" --prefix "$prefix" >"$work/install.log"
# a copy outside the source tree, so that nothing is found there by chance
cp -r "$source/client/examples" "$example"

cmake -S "$example" -B "$work/by-cmake" -DCMAKE_PREFIX_PATH="$prefix" >"$work/cmake.log"
cmake --build "$work/by-cmake" >>"$work/cmake.log"

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name percuss.pc)")
export PKG_CONFIG_PATH
libraries=$(pkg-config --variable=libdir percuss)
# words of the flags are to be split
# shellcheck disable=SC2046
${CC:-cc} -std=c17 -Wall -Wextra -Werror $(pkg-config --cflags percuss) "$example/query.c" \
    -o "$work/by-pkg-config" $(pkg-config --libs percuss) -Wl,-rpath,"$libraries"

# nothing but percuss_ leaves the libraries, and their headers do not need those of DDS
for library in libpercuss libpercuss-slowscale; do
    if nm -D --defined-only "$libraries/$library.so" | awk '{print $3}' | grep -v '^percuss_' ||
        nm -D --defined-only "$libraries/$library.so" | grep ' percuss_v2_'; then
        echo "$library exports symbols of its inside" >&2
        exit 1
    fi
done
# the slow scale stands alone
if ldd "$libraries/libpercuss-slowscale.so" | grep -E 'dds|lapack|blas|sundials'; then
    echo "libpercuss-slowscale needs more than the C library" >&2
    exit 1
fi
pkg-config --exists percuss-slowscale
if grep -rl 'dds/' "$prefix/include/percuss"; then
    echo "a public header includes DDS" >&2
    exit 1
fi

for file in bin/percuss share/percuss/percuss_wire.idl share/man/man1/percuss.1 \
    share/man/man8/percussd.8 include/percuss/percuss.h include/percuss/vocabulary.h \
    include/percuss/slowscale.h include/percuss/slow_equations.h share/percuss/catalogue.yaml \
    share/percuss/percussd.yaml share/doc/percuss/integrating.md; do
    test -f "$prefix/$file" || { echo "$file is not installed" >&2; exit 1; }
done
"$prefix/bin/percuss" --version
"$prefix"/*bin/percussd --config "$prefix/share/percuss/percussd.yaml" --check-config >/dev/null

if [ -n "$domain" ]; then
    "$work/by-cmake/query" "$domain" | grep '^e = ' >"$work/one"
    "$work/by-pkg-config" "$domain" | grep '^e = ' >"$work/other"
    cmp "$work/one" "$work/other"
fi
echo "install_example: passed"
