#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Parameters for other simulators: the page's table is what its script prints today, each program's text is
# there, and what no contact like theirs can do is refused by name. (MuJoCo itself: python/mujoco.)
. "$(dirname "$0")/../support/lib.sh"
export="$bin/percuss export --local --catalogue $source_dir/config/catalogue.yaml --a steel-sphere"

say "docs/reference/engines.md"
python3 "$source_dir/client/examples/engines/pairs.py" "$bin/percuss" >table.md || fail "pairs.py"
[ "$(wc -l <table.md)" -eq 11 ] || fail "another table: $(cat table.md)"
while read -r line; do
    grep -qxF "$line" "$source_dir/docs/reference/engines.md" || fail "docs/reference/engines.md has not: $line"
done <table.md

say "each program's own text, by the same fit"
for program in mujoco bullet chrono drake dem abaqus; do
    expect 0 $export --b al-rod-1 --speed 0.1:0.4:3 --for $program
    case $program in
    mujoco) what='condim="1" solref="-' ;;
    bullet) what='p.changeDynamics(A, -1, restitution=0.54' ;;
    chrono) what='rigid->SetRestitution(0.54' ;;
    drake) what='geometry::AddContactMaterial(' ;;
    dem) what='linear_nohistory 0.0 0.0 damping coeff_restitution' ;;
    abaqus) what='*CONTACT DAMPING, DEFINITION=DAMPING COEFFICIENT' ;;
    esac
    grep -qF -- "$what" "$out" || fail "$program: $(cat "$out")"
    [ "$(grep -c ' 0\.[0-9]* *0\.[0-9]* ' "$out")" -ge 3 ] || fail "$program: no three speeds: $(cat "$out")"
done
expect 0 $export --b al-rod-1 --speed 0.1:0.4:3 --for mujoco
{ echo '<a>' && cat "$out" && echo '</a>'; } | python3 -c 'import sys, xml.etree.ElementTree as t; t.parse(sys.stdin)' ||
    fail "no XML: $(cat "$out")"

say "what is asked wrongly"
expect 2 $export --b al-rod-1 --speed 0.1:0.4 --for unity
grep -q "'unity': mujoco, bullet, chrono, drake, dem or abaqus is allowed" "$err" || fail "unity: $(cat "$err")"
expect 2 $export --b al-rod-1 --speed 0.4:0.1 --for mujoco
grep -q '0 < LO <= HI is needed, here 0.4 to 0.1 m/s' "$err" || fail "backwards: $(cat "$err")"
expect 2 $export --b al-rod-1 --speed 0.4 --for mujoco
grep -q "'0.4' is not LO:HI" "$err" || fail "one speed: $(cat "$err")"
expect 2 $export --b al-rod-1
grep -q -- '--for PROGRAM' "$err" || fail "no program: $(cat "$err")"
expect 5 $export --b nobody --speed 0.1:0.4 --for mujoco
grep -q 'nobody' "$err" || fail "no body: $(cat "$err")"
expect 2 $export --b al-rod-1 --speed 0.1:0.4:1 --for mujoco
grep -q 'N of 2..1000 is needed' "$err" || fail "one point: $(cat "$err")"
# cut off before its second blow
expect 5 $export --b al-beam --speed 0.1:0.4:2 --for mujoco --horizon 0.2ms
grep -q 'at 0.1 m/s: the restitution is not final' "$err" || fail "not final: $(cat "$err")"
