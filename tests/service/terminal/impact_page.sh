#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# An impact as a page: opened in a browser without a network it says the numbers of the answer, and its animation runs,
# stops, is slowed and dragged. What it draws is the solver's. So are the charts of the pages of many impacts.
. "$(dirname "$0")/../support/lib.sh"
command -v chromium >/dev/null || {
    echo "chromium is not installed (sh deploy/dependencies.sh test): skipped"
    exit 77
}
pair="--local --a steel-sphere --b al-beam --speed 0.276"

# add NAME PAGE PROBE: a page to be opened, with its probe at its end
add() {
    {
        printf '<iframe id="%s" width="1000" height="900" data-page="' "$1"
        {
            echo "<script>" && cat "$support/frames.js" && echo "</script>" && cat "$2"
            echo "<script>" && cat "$support/$3.js" && echo "</script>"
        } | sed -e 's/&/\&amp;/g' -e 's/"/\&quot;/g'
        echo '"></iframe>'
    } >>"$work/frames"
}

# open_all: opens all pages, in one browser as each start of it takes seconds; what is found is in $work/probes
open_all() {
    {
        echo '<!DOCTYPE html><meta charset="utf-8"><pre id="probes"></pre>' && cat "$work/frames"
        echo "<script>" && cat "$support/probes.js" && echo "</script>"
    } >"$work/all.html"
    # the profile and the crashes of a browser of its own; no host has an address
    HOME=$work timeout 240 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage \
        --user-data-dir="$work/chromium" --host-resolver-rules="MAP * ~NOTFOUND" --virtual-time-budget=60000 \
        --dump-dom "file://$work/all.html" >"$work/dom" 2>"$err" || fail "chromium"
    sed -n '/<pre id="probes">/,/<\/pre>/p' "$work/dom" |
        sed -e 's/.*<pre id="probes">//' -e 's/&gt;/>/g' -e 's/&lt;/</g' -e 's/&nbsp;/ /g' -e 's/&amp;/\&/g' >"$work/probes"
    grep -q '^end of all' "$work/probes" || fail "not all pages were opened"
}

# probe NAME: leaves in $work/probe what was found in that page
probe() {
    sed -n "/^page $1\$/,/^end of the probe/p" "$work/probes" >"$work/probe"
    cp "$work/probe" "$out"
    grep -q '^end of the probe' "$work/probe" || fail "$1: the page did not run"
    ! grep '^error ' "$work/probe" || fail "$1: an error"
}

# found NAME [VALUE]: that of the last probe
found() {
    grep -qx "$1 ${2:-true}" "$work/probe" || fail "$1 is not ${2:-true}"
}

# small NAME MOST: the number at the end of this line is not larger
small() {
    grep "^$1" "$work/probe" | awk -v most="$2" '{ exit !($NF >= 0 && $NF <= most) }' || fail "$1 is not below $2"
}

# lives: the animation of the last probe
lives() {
    for what in runs stops slower dragged moves returns zooms request; do
        found $what
    done
}

say "pages of impacts: the paper's beam; a rod, whose waves run along, with names that would end the page's data; two contacts"
expect 0 percuss query $pair --json
e=$(sed -n 's/^ *"restitution": \([0-9.]*\),*$/\1/p' "$out" | awk '{ printf "%.6g", $1 }')
expect 0 percuss query $pair --html "$work/impact.html"
grep -q "restitution  $e" "$out" || fail "not $e"
[ "$(wc -c <"$work/impact.html")" -lt 400000 ] || fail "the page is large"
add beam "$work/impact.html" probe
add documented "$source_dir/docs/figures/impact-beam.html" probe
cat >"$work/names.yaml" <<END
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800, yield: 1e9}
bodies:
  "ball</script>": {shape: sphere, material: steel, radius: 0.01}
  rod: {shape: rod, material: steel, radius: 0.01, length: 0.5, tip_radius: 0.02, ends: [fixed, free]}
END
expect 0 percuss query --local --catalogue "$work/names.yaml" --a "ball</script>" --b rod --speed 0.1 --html "$work/rod.html"
add rod "$work/rod.html" probe
cat >"$work/two.json" <<END
{"bodies": [{"id": "steel-sphere", "position": [-0.2, 0, 0.025], "velocity": [0.2, 0, -0.3]},
            {"id": "glass-sphere", "position": [0.2, 0, 0.02], "velocity": [0, 0, -0.3], "overrides": {"density": 9000}},
            {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 2, "point": [-0.2, 0, 0.01], "normal": [0, 0, 1], "friction": 0.2},
              {"a": 1, "b": 2, "point": [0.2, 0, 0.01], "normal": [0, 0, 1]}]}
END
expect 0 percuss query --local --request "$work/two.json" --html "$work/two.html"
add two "$work/two.html" probe
rm "$work/two.html"

say "pages of many: a sweep over logarithmic speeds on two bodies with measured impacts; one over the angle; an ensemble; a comparison"
printf 'speed,restitution,sub_impacts\n0.02,0.5,1\n0.2,0.7,2\n0.2,0.9,\n' >"$work/rig.csv"
many="--local --a steel-sphere --b al-beam"
expect 0 percuss sweep $many --b al-rod-1 --speed 0.01:1:3:log --measured "$work/rig.csv" --html "$work/sweep.html" --csv
cp "$out" "$work/sweep.csv"
add sweep "$work/sweep.html" probe_results
# the values as a page alone, and the table elsewhere
expect 0 percuss sweep $many --speed 0.3 --angle 0:80:3 --friction 0.3 --html -
tail -n 1 "$out" | grep -qx '</html>' && head -n 1 "$out" | grep -qx '<!DOCTYPE html>' || fail "standard output is not the page"
grep -q 'steel-sphere\|speed m/s' "$err" || fail "no table"
add angles "$out" probe_results
expect 0 percuss ensemble $many --speed uniform:0.1:0.4 --input young@al-beam=normal:70e9:1e9 --samples 60 --html "$work/ensemble.html"
cp "$out" "$work/ensemble.txt"
add ensemble "$work/ensemble.html" probe_results
expect 0 percuss compare "$work/rig.csv" $many --csv --html "$work/comparison.html"
cp "$out" "$work/comparison.csv"
add comparison "$work/comparison.html" probe_results
open_all

say "the paper's beam: its restitution, its warning, the animation; the line is the solver's"
probe beam
found restitution "$e ± 0\.71"
grep -q '^warnings Warning: .*no yield' "$work/probe" || fail "no warning"
lives
# the largest force of the histories' instants: 304.7 N, of the solver's 305.0 N, 0.065 ms after the touch
grep -q '^now 0\.06[0-9]* ms: force 304\.7 N, indentation 11\.57 ' "$work/probe" || fail "not the peak's values"
grep -q '^pointer .*force:.*304\.7 N' "$work/probe" || fail "no value under the pointer"
found command "percuss query .*$pair --html $work/impact.html"
# modes that the page has not, and its frequencies to the first order: 0.4 %; the force between the instants of the
# histories, which is no straight line: 5e-4 of the velocities
found "drawn steel-sphere" "rigid .*"
found "drawn al-beam" "line .*"
small "drawn al-beam" 0.01
small velocities 2e-3
small vibration 1e-3

say "the page in the documentation is the same impact, by the same scripts"
[ "$(diff "$build/client/page.html" "$source_dir/docs/figures/impact-beam.html" | grep -c '^<')" -eq 1 ] ||
    fail "more than the data differs: percuss query --html makes it anew"
probe documented
found restitution "$e ± 0\.71"
lives

say "a rod"
probe rod
lives
found "drawn rod" "line .*"
small "drawn rod" 0.02
small vibration 2e-3

say "several contacts at once, one with friction, of a body whose mass a request changes: what the page does not know it says"
probe two
lives
found vibration unknown
small "drawn al-beam" 0.01
found "drawn steel-sphere" "rigid .*"
found "drawn glass-sphere" "still .*"
grep -q '^told .*Its motion as a whole is not known' "$work/probe" || fail "a body that is drawn at rest, and no word of it"
# value FILE ROW COLUMN DIGITS: that of a file of values, as a page says it
value() {
    awk -F, -v row="$2" -v name="$3" -v digits="$4" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) column = i }
        NR == row + 1 { printf "%." digits "g", $column }' "$1"
}

# shows: the charts of the last probe are drawn, and hold every point with its bar; nothing of an impact is in the way
shows() {
    for chart in "$@"; do
        found "inside $chart" && found "drawn $chart"
    done
    found impact 0
    [ "$(grep -c '^chart ' "$work/probe")" -eq $# ] || fail "other charts than $*"
}

say "the sweep: the values under the pointer are those of --csv, with bars; measured impacts beside them; logarithmic speeds"
probe sweep
shows restitution sub-impacts duration peak-force impulse
found title "steel-sphere on bodies at rest"
# speeds of 0.01, 0.1, 1 m/s, and two measured ones, one of them twice
found "chart restitution" "6 rows of al-beam; al-rod-1; measured: rig.csv"
found "x restitution" logarithmic
found "bars restitution" "2 of 2"
first=$(value "$work/sweep.csv" 1 restitution 5) wide=$(value "$work/sweep.csv" 1 error_total 2)
grep -q "^first restitution 0\.01 m/s:.*al-beam: *$first ± $wide" "$work/probe" || fail "not $first ± $wide under the pointer"
last=$(value "$work/sweep.csv" 6 impulse 5)
grep -q "^last impulse 1 m/s:.*al-rod-1: *$last N s" "$work/probe" || fail "not $last under the pointer"
grep -q '^warnings Warning: .*of al-beam, auto, at' "$work/probe" || fail "no warning"
found number "points | 6 | 6 OK"
found tables "3 3"
found request 2
found command "percuss sweep .*--measured $work/rig.csv --html $work/sweep.html --csv"

say "over the angle, with friction"
probe angles
shows restitution sub-impacts duration peak-force impulse tangential-impulse tangential-restitution
grep -q '^last tangential-impulse 80 degrees:.* mN s' "$work/probe" || fail "no angle"

say "the ensemble: the numbers of the table, its inputs, any column over any other"
probe ensemble
shows histogram distribution samples
mean=$(awk '$1 == "restitution" { printf "%.3f", $3 }' "$work/ensemble.txt")
grep "^number restitution | " "$work/probe" | awk -v mean="$mean" '{ exit !(sprintf("%.3f", $4) == mean) }' || fail "not $mean"
grep -q '^number cause | speed | ' "$work/probe" || fail "no cause"
found chosen impulse
found number "samples | 60 | .*"

say "the comparison: measured beside simulated, residuals, that p-values need more impacts"
probe comparison
shows restitution residual sub-impacts distribution
residual=$(value "$work/comparison.csv" 1 residual 5)
grep -q "^first residual 0\.02 m/s:.*: *$residual" "$work/probe" || fail "not $residual"
grep -q '^number Kolmogorov-Smirnov .* 3 impacts are too few for a p-value: 4 or more are needed' "$work/probe" || fail "a p-value"
found tables 3

say "files that cannot be written are named, and so is more than one answer"
expect 2 percuss query $pair --html "$work/none/impact.html"
says "--html: $work/none/impact.html: cannot be written: No such file or directory"
expect 1 percuss query $pair --html /dev/full
says "--html: /dev/full: could not be written: No space left on device"
expect 2 percuss query $pair --speed 0.3 --html "$work/two.html"
says "--html: one --speed and one --contact-model are needed, not 2 and 0"
[ ! -e "$work/two.html" ] || fail "a page of two answers"
expect 2 percuss sweep $many --speed 0.1:0.2:2 --html "$work/none/sweep.html"
says "--html: $work/none/sweep.html: cannot be written: No such file or directory"
