#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Puts a file between the marks of a page, <!-- NAME begin --> and <!-- NAME end -->, in place of what stands there. A
# page without one line of each, in this order, is left as it is: exit code 1.
# usage: tables.sh PAGE FILE [NAME]    (NAME: tables)
set -eu
page=${1:?usage: tables.sh PAGE FILE [NAME]}
file=${2:?usage: tables.sh PAGE FILE [NAME]}
name=${3:-tables}
work=$(mktemp)
trap 'rm -f "$work"' EXIT
awk -v file="$file" -v name="$name" '
    $0 == "<!-- " name " end -->" { ends++; if (!inside) wrong = 1; inside = 0 }
    !inside { print }
    $0 == "<!-- " name " begin -->" {
        inside = 1; begins++
        while ((more = (getline line < file)) > 0) print line
        if (more < 0) wrong = 1
    }
    END { exit wrong || begins != 1 || ends != 1 }' "$page" >"$work" || {
    echo "tables: $page must have one line of each, <!-- $name begin --> and <!-- $name end -->, and $file must be there" >&2
    exit 1
}
cp "$work" "$page"
