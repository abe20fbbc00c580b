#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The binary interface of the shared libraries: every member of a public struct with its offset and size, every
# enumerator with its value, every prototype, from the public headers. Fails where it differs from the record of
# this SOVERSION beside this script. A line of the record that changed or went needs the next SOVERSION
# (PERCUSS_SOVERSION in CMakeLists.txt, and _NUMBER in client/python/percuss/_library.py); a new line is added to the
# record by --record, which refuses to change any other. Delete a record only while no release has its SOVERSION.
# usage: abi.sh SOURCE_DIR SOVERSION [--record]    exit 77: pahole is not here
# environment: CC, PERCUSS_ABI_RECORDS (a folder; default: this one)
set -eu
records=${PERCUSS_ABI_RECORDS:-$(cd "$(dirname "$0")" && pwd)}
cd "$1"
record=$records/$2.txt
command -v pahole >/dev/null || {
    echo "abi: NOT TRIED: pahole (Debian's dwarves) is not installed" >&2
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# one object with the debug information of all types
for header in client/include/percuss/*.h; do
    echo "#include <percuss/$(basename "$header")>"
done >"$work/all.c"
"${CC:-cc}" -g -fno-eliminate-unused-debug-types -Iclient/include -Iidl -c "$work/all.c" -o "$work/all.o"

members() {
    pahole "$work/all.o" | awk '
        /^struct percuss_/ { owner = $2; next }
        /^[a-z]/ { owner = "" }
        owner == "" { next }
        /^\t\/\* size: / { sub(/,.*/, ""); print "size    " owner " " $3; next }
        /;.*\/\*  *[0-9]+  *[0-9]+ \*\/$/ {
            sub(/^[ \t]+/, "")
            gsub(/[ \t]+/, " ")
            sub(/; \/\*/, " at")
            sub(/ \*\/$/, "")
            print "member  " owner ": " $0
        }'
}

# but for the counts, which grow with each new enumerator
enumerators() {
    readelf --debug-dump=info "$work/all.o" | awk '
        /DW_TAG_enumerator\)/ { inside = 1; next }
        /DW_TAG_/ { inside = 0 }
        inside && /DW_AT_name/ { name = $NF }
        inside && /DW_AT_const_value/ && name ~ /^PERCUSS_/ && name !~ /_COUNT$/ { print name, $NF }' |
        while read -r name value; do
            printf 'value   %s %d\n' "$name" "$value" # which compilers write in different bases
        done
}

prototypes() {
    cat client/include/percuss/*.h | tr '\n' ' ' | sed 's|/\*[^*]*\*\+\([^/*][^*]*\*\+\)*/||g' |
        grep -o 'PERCUSS_API [a-z][^;#]*;' | sed 's/  */ /g; s/^PERCUSS_API /call    /'
}

{ members && enumerators && prototypes; } | LC_ALL=C sort -u >"$work/today"
for kind in size member value call; do
    grep -q "^$kind " "$work/today" || { echo "abi: no $kind was found in client/include/percuss" >&2 && exit 1; }
done

touch "$work/none"
[ -e "$record" ] && recorded=$record || recorded=$work/none
LC_ALL=C comm -23 "$recorded" "$work/today" >"$work/gone"
LC_ALL=C comm -13 "$recorded" "$work/today" >"$work/new"
if [ -s "$work/gone" ]; then
    echo "abi: of interface $2 these are gone or changed, and programs built with it would fail; restore them, or" \
        "take the next PERCUSS_SOVERSION:" >&2
    sed 's/^/  /' "$work/gone" >&2
    exit 1
fi
if [ "${3:-}" = --record ]; then
    cp "$work/today" "$record"
elif [ -s "$work/new" ]; then
    echo "abi: not recorded; run: sh tests/abi/abi.sh . $2 --record" >&2
    sed 's/^/  /' "$work/new" >&2
    exit 1
fi
echo "abi: interface $2: $(grep -c '^size' "$work/today") structs, $(grep -c '^value' "$work/today") enumerators," \
    "$(grep -c '^call' "$work/today") functions"
