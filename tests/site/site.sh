#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The site of the documents is built without a warning and has no dead link; and what is to find that does.
# usage: site.sh SOURCE
set -eu
source_dir=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# build SOURCE: as the target does, into $work/site; what is wrong in $work/said
build() {
    code=0
    sphinx-build -q -W --keep-going -n -b html -c "$source_dir/deploy/site" -d "$work/trees" "$1" "$work/site" \
        >"$work/said" 2>&1 || code=$?
    python3 "$here/dead_links.py" "$work/site" >>"$work/said" || code=$?
    return "$code"
}

fail() {
    echo "FAILED: $*"
    cat "$work/said"
    exit 1
}

build "$source_dir" || fail "the site"
pages=$(find "$source_dir/docs" -name '*.md' | wc -l)
[ "$(find "$work/site/docs" -name '*.html' | wc -l)" -eq "$pages" ] || fail "not every page is in the site"
grep -q 'url=README.html' "$work/site/index.html" || fail "it does not begin with its first page"
for figure in $(grep -oh 'figures/[A-Za-z0-9_.-]*\.\(png\|svg\)' "$source_dir"/docs/*.md "$source_dir"/docs/*/*.md | sort -u); do
    [ -s "$work/site/_images/${figure#figures/}" ] || fail "$figure is not in the site"
done

# a copy with all that is to be found: links to no page, heading, file and figure, and a page nobody links
mkdir "$work/copy"
for name in client idl config deploy; do
    ln -s "$source_dir/$name" "$work/copy/$name"
done
cp -r "$source_dir/docs" "$source_dir/README.md" "$source_dir/SECURITY.md" "$source_dir/CHANGELOG.md" \
    "$source_dir/CONTRIBUTING.md" "$work/copy"
cat >>"$work/copy/docs/mesh.md" <<'END'

A link to [no page](no-page.md), [no heading of one](specimens.md#no-heading), [of this one](#no-own-heading),
[no file](../client/examples/no-file.c).

![no figure](figures/no-figure.png)
END
echo '# A page' >"$work/copy/docs/lonely.md"
rm -rf "$work/site" "$work/trees"
! build "$work/copy" || fail "nothing is wrong in a copy where much is"
for wrong in no-page no-heading no-own-heading no-file no-figure lonely; do
    grep -q "$wrong" "$work/said" || fail "$wrong is not found"
done
echo "$pages pages"
