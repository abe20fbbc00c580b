#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Whether the pages about catalogue, settings and requests, and the schemas beside the shipped files, hold what the
# tables say that check them; with --write they are made so: what stands between a page's two marks is replaced. And
# whether the shipped settings show the same defaults.
# usage: reference.sh SOURCE FOLDER PERCUSS [--write]    (FOLDER: of print_reference and print_schema)
set -eu
[ $# -ge 3 ] || {
    echo "usage: reference.sh SOURCE FOLDER PERCUSS [--write]" >&2
    exit 2
}
source_dir=$1
folder=$2
print=$folder/print_reference
percuss=$3
write=${4:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# page FILE COMMAND...
page() {
    page=$1
    shift
    "$@" >"$work/keys"
    awk -v keys="$work/keys" '
        /end of the keys/ { inside = 0; ends++ }
        !inside { print }
        /keys: by tests\/reference/ {
            inside = 1; begins++
            while ((getline line < keys) > 0) print line
        }
        END { exit begins != 1 || ends != 1 }' "$source_dir/$page" >"$work/page" || {
        echo "$page: must have one line with each mark" >&2
        exit 1
    }
    if [ "$write" ]; then
        cmp -s "$work/page" "$source_dir/$page" || cp "$work/page" "$source_dir/$page"
    else
        diff -u "$source_dir/$page" "$work/page" || failed=1
    fi
}

# schema KIND FILE
schema() {
    "$folder/print_schema" "$1" >"$work/schema"
    if [ "$write" ]; then
        cmp -s "$work/schema" "$source_dir/$2" || cp "$work/schema" "$source_dir/$2"
    else
        diff -u "$source_dir/$2" "$work/schema" || failed=1
    fi
}

schema catalogue config/catalogue.schema.json
schema settings config/percussd.schema.json
page docs/reference/catalogue.md "$print" catalogue markdown
page client/man/percuss-catalogue.5 "$print" catalogue man
page docs/reference/settings.md "$print" settings markdown
page client/man/percussd.yaml.5 "$print" settings man
page docs/reference/requests.md python3 "$source_dir/tests/reference/members.py" "$percuss"
python3 "$source_dir/tests/reference/shipped.py" "$source_dir/docs/reference/settings.md" "$source_dir/config/percussd.yaml" ||
    exit 1
[ "$failed" -eq 0 ] || echo "the tables have changed: tests/reference/reference.sh ... --write" >&2
exit "$failed"
