#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# An impact as a page: opened in a browser without a network it says the numbers of the answer, and its animation runs,
# stops, is slowed and dragged. What it draws is the solver's.
. "$(dirname "$0")/../support/lib.sh"
command -v chromium >/dev/null || {
    echo "chromium is not installed (sh deploy/dependencies.sh test): skipped"
    exit 77
}
pair="--local --a steel-sphere --b al-beam --speed 0.276"

# probe PAGE: opens it, with the probe at its end, and leaves in $work/probe what it finds
probe() {
    {
        echo "<script>" && cat "$support/frames.js" && echo "</script>" && cat "$1"
        echo "<script>" && cat "$support/probe.js" && echo "</script>"
    } >"$work/probed.html"
    # the profile and the crashes of a browser of its own; no host has an address
    HOME=$work timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage \
        --user-data-dir="$work/chromium" --host-resolver-rules="MAP * ~NOTFOUND" --virtual-time-budget=5000 \
        --dump-dom "file://$work/probed.html" >"$work/dom" 2>"$err" || fail "chromium: $1"
    sed -n '/<pre id="probe">/,/<\/pre>/p' "$work/dom" | sed -e 's/.*<pre id="probe">//' -e 's/&gt;/>/g' >"$work/probe"
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

say "the paper's beam: its restitution, its warning, the animation; the line is the solver's"
expect 0 percuss query $pair --json
e=$(sed -n 's/^ *"restitution": \([0-9.]*\),*$/\1/p' "$out" | awk '{ printf "%.6g", $1 }')
expect 0 percuss query $pair --html "$work/impact.html"
grep -q "restitution  $e" "$out" || fail "not $e"
[ "$(wc -c <"$work/impact.html")" -lt 400000 ] || fail "the page is large"
probe "$work/impact.html"
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
[ "$(diff "$build/client/impact.html" "$source_dir/docs/figures/impact-beam.html" | grep -c '^<')" -eq 1 ] ||
    fail "more than the data differs: percuss query --html makes it anew"
probe "$source_dir/docs/figures/impact-beam.html"
found restitution "$e ± 0\.71"
lives

say "a rod, whose waves run along; names that would end the page's data; a request repeats the answer"
cat >"$work/names.yaml" <<END
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800, yield: 1e9}
bodies:
  "ball</script>": {shape: sphere, material: steel, radius: 0.01}
  rod: {shape: rod, material: steel, radius: 0.01, length: 0.5, tip_radius: 0.02, ends: [fixed, free]}
END
expect 0 percuss query --local --catalogue "$work/names.yaml" --a "ball</script>" --b rod --speed 0.1 --html "$work/rod.html"
probe "$work/rod.html"
lives
found "drawn rod" "line .*"
small "drawn rod" 0.02
small vibration 2e-3

say "several contacts at once, one with friction, of a body whose mass a request changes: what the page does not know it says"
cat >"$work/two.json" <<END
{"bodies": [{"id": "steel-sphere", "position": [-0.2, 0, 0.025], "velocity": [0.2, 0, -0.3]},
            {"id": "glass-sphere", "position": [0.2, 0, 0.02], "velocity": [0, 0, -0.3], "overrides": {"density": 9000}},
            {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 2, "point": [-0.2, 0, 0.01], "normal": [0, 0, 1], "friction": 0.2},
              {"a": 1, "b": 2, "point": [0.2, 0, 0.01], "normal": [0, 0, 1]}]}
END
expect 0 percuss query --local --request "$work/two.json" --html "$work/two.html"
probe "$work/two.html"
lives
found vibration unknown
small "drawn al-beam" 0.01
found "drawn steel-sphere" "rigid .*"
found "drawn glass-sphere" "still .*"
grep -q 'Its motion as a whole is not known' "$work/dom" || fail "a body that is drawn at rest, and no word of it"
rm "$work/two.html"

say "files that cannot be written are named, and so is more than one answer"
expect 2 percuss query $pair --html "$work/none/impact.html"
says "--html: $work/none/impact.html: cannot be written: No such file or directory"
expect 1 percuss query $pair --html /dev/full
says "--html: /dev/full: could not be written: No space left on device"
expect 2 percuss query $pair --speed 0.3 --html "$work/two.html"
says "--html: one --speed and one --contact-model are needed, not 2 and 0"
[ ! -e "$work/two.html" ] || fail "a page of two answers"
