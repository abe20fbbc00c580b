#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The reference of the C interface has every public function, and a function without a comment is refused.
# usage: c_reference.sh SOURCE
set -eu
source_dir=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sh "$source_dir/deploy/reference/make.sh" "$source_dir" "$work/pages" >"$work/said" 2>&1 || {
    cat "$work/said"
    exit 1
}
sed -n 's/^call .*[ *]\(percuss_[a-z_0-9]*\)(.*/\1/p' "$source_dir"/tests/abi/*.txt | sort -u >"$work/functions"
while read -r function; do
    grep -q "\"memname\">.*$function" "$work"/pages/*_8h.html || {
        echo "FAILED: $function is in no page" && exit 1
    }
done <"$work/functions"

mkdir -p "$work/copy/client" "$work/copy/idl"
cp -r "$source_dir/client/include" "$work/copy/client"
cp -r "$source_dir/idl/percuss" "$work/copy/idl"
ln -s "$source_dir/deploy" "$work/copy/deploy"
sed -i '/^\/\* The version of the library/d' "$work/copy/client/include/percuss/result.h"
! sh "$source_dir/deploy/reference/make.sh" "$work/copy" "$work/bad" >"$work/said" 2>&1 || {
    echo "FAILED: a function without a comment passes" && exit 1
}
grep -q 'percuss_version(void) (function)' "$work/said" || { cat "$work/said" && exit 1; }
echo "c_reference: $(wc -l <"$work/functions") functions"
