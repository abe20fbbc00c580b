#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Whether the pages about catalogue and settings hold what the tables say that check them; with --write
# they are made so: what stands between their two marks is replaced.
# usage: reference.sh SOURCE PRINT_REFERENCE [--write]
set -eu
[ $# -ge 2 ] || {
    echo "usage: reference.sh SOURCE PRINT_REFERENCE [--write]" >&2
    exit 2
}
source_dir=$1
print=$2
write=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# page FILE WHAT FORM
page() {
    "$print" "$2" "$3" >"$work/keys"
    awk -v keys="$work/keys" '
        /end of the keys/ { inside = 0; ends++ }
        !inside { print }
        /keys: by tests\/reference/ {
            inside = 1; begins++
            while ((getline line < keys) > 0) print line
        }
        END { exit begins != 1 || ends != 1 }' "$source_dir/$1" >"$work/page" || {
        echo "$1: must have one line with each mark" >&2
        exit 1
    }
    if [ "$write" ]; then
        cmp -s "$work/page" "$source_dir/$1" || cp "$work/page" "$source_dir/$1"
    else
        diff -u "$source_dir/$1" "$work/page" || failed=1
    fi
}

page docs/catalogue.md catalogue markdown
page client/man/percuss-catalogue.5 catalogue man
page docs/settings.md settings markdown
page client/man/percussd.yaml.5 settings man
[ "$failed" -eq 0 ] || echo "the tables have changed: tests/reference/reference.sh SOURCE PROGRAM --write" >&2
exit "$failed"
