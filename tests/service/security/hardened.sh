#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The programs and libraries that were built have what the compiler and the linker know against attacks.
. "$(dirname "$0")/../support/lib.sh"

# has PATTERN WHAT: in what readelf said last
has() {
    grep -q -- "$1" "$out" || fail "$file: $2"
}

files="$bin/percussd $bin/percuss $bin/percuss-tables $bin/percuss-reduce"
for library in percuss percuss-measured percuss-slowscale; do
    files="$files $(find "$build/client" -name "lib$library.so" | head -n 1)"
done
for file in $files; do
    say "${file##*/}"
    expect 0 readelf -W -h -l -d "$file"
    has 'Type: *DYN' "can lie at one address only"
    has 'GNU_RELRO' "no relocations that become constant"
    has 'FLAGS_1.*NOW' "binds late, so that its tables can be written"
    has 'GNU_STACK.* RW ' "a stack that is code"
    grep -q 'RWE' "$out" && fail "$file: memory that is both code and data"
    expect 0 readelf -W --dyn-syms "$file"
    has '__stack_chk_fail' "no stack protector"
    case $file in
    *slowscale*) ;; # copies nothing whose size is unknown
    *) has '_chk@' "no FORTIFY" ;;
    esac
done

say "functions that are called by address begin with a mark"
if [ "$(uname -m)" = x86_64 ]; then
    for file in $files; do
        objdump -d "$file" >"$out" 2>"$err"
        has 'endbr64' "no marks for jumps"
    done
fi
