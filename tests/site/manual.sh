#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The manual keeps its size: at most 16 pages in docs/ beside their list, index.md, each of at most 2,600 words, ten minutes of reading. Measurements
# are in docs/lab, generated tables and other pages to look things up in docs/reference.
# usage: manual.sh SOURCE
set -eu
source_dir=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# too_long FOLDER: a line for each page, and for the number of pages, that is beyond the limit
too_long() {
    for page in "$1"/*.md; do
        words=$(wc -w <"$page")
        [ "$words" -le 2600 ] || echo "${page##*/}: $words words: at most 2600 are allowed"
    done
    pages=$(find "$1" -maxdepth 1 -name '*.md' ! -name index.md | wc -l)
    [ "$pages" -le 16 ] || echo "$pages pages: at most 16 are allowed"
}

too_long "$source_dir/docs" >"$work/found"
[ ! -s "$work/found" ] || {
    cat "$work/found" >&2
    exit 1
}

# both limits are seen
mkdir "$work/docs"
cp "$source_dir"/docs/*.md "$work/docs"
for number in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
    yes word | head -n 2601 >"$work/docs/made-up-$number.md"
done
too_long "$work/docs" >"$work/found"
grep -q '^made-up-1.md: 2601 words' "$work/found" && grep -q 'pages: at most 16' "$work/found" || {
    echo "a manual that is too long is not noticed" >&2
    exit 1
}
echo "manual: $(find "$source_dir/docs" -maxdepth 1 -name '*.md' ! -name index.md | wc -l) pages"
