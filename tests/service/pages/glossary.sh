#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A reader looks the words of an answer up in the glossary.
. "$(dirname "$0")/../support/lib.sh"
page=$source_dir/docs/glossary.md

ask() {
    "$bin/percuss" query --local --catalogue "$source_dir/config/catalogue.yaml" --a steel-sphere "$@"
}
expect 0 ask --b al-rod-1 --speed 0.3
cp "$out" "$work/answers"
expect 0 ask --b al-beam --speed 0.276
cat "$out" >>"$work/answers"
expect 0 ask --b al-beam --speed 0.3 --angle 30 --friction 0.3
cat "$out" >>"$work/answers"

say "what the lines of an answer begin with"
sed -n 's/^  \([a-z][a-z-]*\( [a-z]*\)*\)  .*/\1/p' "$work/answers" | sort -u >"$work/labels"
[ "$(wc -l <"$work/labels")" -ge 6 ] || fail "labels: $(cat "$work/labels")"
while read -r label; do
    grep -qi "^| [^|]*${label%s}" "$page" || fail "the glossary lacks: $label"
done <"$work/labels"

say "the terms within its lines"
while read -r term; do
    grep -qF -- "$term" "$work/answers" || fail "no answer says: $term"
    grep -qF -- "$term" "$page" || fail "the glossary lacks: $term"
done <<'END'
+-
modes and steps
N s stops the approach
SEPARATED
closure
matched
residual flexibility
yield
dent
table
timoshenko
what was left out
catalogue revision
END
