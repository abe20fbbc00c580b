#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# latency.sh fills each table of the page and leaves the rest of it alone; no times are judged.
# usage: latency_test.sh BUILD
set -eu
here=$(cd "$(dirname "$0")" && pwd)
page=$here/../../docs/lab/latency.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*" >&2
    cat "$work/latency.md" >&2
    exit 1
}

# outside FILE: all but what is between marks
outside() {
    awk '/^<!-- [a-z]+ end -->$/ { inside = 0 } !inside { print } /^<!-- [a-z]+ begin -->$/ { inside = 1 }' "$1"
}

# the tables are empty before
outside "$page" >"$work/before"
cp "$work/before" "$work/latency.md"
sh "$here/latency.sh" --quick "$1" "$work" >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail "latency.sh"
}
outside "$work/latency.md" >"$work/after"
cmp "$work/before" "$work/after" || fail "more than the tables is changed"
# what is in them: a head of two lines, then the scenes, each field a number; ping is not solved
for table in trips:5:9 throughput:4:4 fixed:4:6; do
    name=${table%%:*} scenes=${table#*:}
    awk -v name="$name" '$0 == "<!-- " name " end -->" { inside = 0 } inside { print }
        $0 == "<!-- " name " begin -->" { inside = 1 }' "$work/latency.md" >"$work/table"
    sed 1,2d "$work/table" | awk -F'|' -v scenes="${scenes%:*}" -v fields="${scenes#*:}" '
        NF != fields + 3 { exit 1 }
        { for (i = 3; i < NF; i++) if ($i !~ /^ -?[0-9]/ && !($2 == " ping " && $i == " ")) exit 1 }
        END { if (NR != scenes) exit 1 }' || fail "the table $name"
done

# a page that lost a mark, or a table that was not made, is left as it is
sed '/<!-- fixed end -->/d' "$page" >"$work/latency.md"
cp "$work/latency.md" "$work/before"
! sh "$here/tables.sh" "$work/latency.md" "$work/table" fixed 2>"$work/log" || fail "a page without an end of its tables"
grep -q "must have one line of each, <!-- fixed begin --> and <!-- fixed end -->" "$work/log" || fail "$(cat "$work/log")"
! sh "$here/tables.sh" "$work/latency.md" "$work/none" trips 2>"$work/log" || fail "a table that is not there"
cmp "$work/before" "$work/latency.md" || fail "a page is changed that cannot be"
echo "latency.sh fills the page's tables"
