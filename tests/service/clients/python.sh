#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# docs/python.md followed: what it shows is run as it stands, beside a daemon and without one, and the examples
# print what the page says. Skipped where the Python tests have no virtual environment.
. "$(dirname "$0")/../support/lib.sh"
. "$source_dir/tests/documents.sh"
venv=$build/python-venv
[ -e "$venv/wanted" ] || {
    say "no virtual environment (see the test python/environment): skipped"
    exit 77
}
PATH=$venv/bin:$PATH
PERCUSS_LIBRARY=$build/client/libpercuss.so
PERCUSS_DOMAIN=$domain
export PATH PERCUSS_LIBRARY PERCUSS_DOMAIN
prints() { # PATTERN
    grep -q "$1" "$out" || fail "stdout does not show: $1"
}
page=$source_dir/docs/python.md
mkdir "$work/here"
ln -s "$source_dir/client" "$source_dir/config" "$work/here"
cd "$work/here"

# snippet N [PAGE]: the page's N-th block of Python
snippet() {
    awk -v wanted="$1" '
        /^```python$/ { inside = 1; n++; next }
        /^```$/ { inside = 0 }
        inside && n == wanted { print; found = 1 }
        END { exit !found }' "${2:-$page}" >snippet.py || fail "no snippet $1"
}

say "a daemon asked: the snippet prints what stands beside its lines"
start_daemon
snippet 1
expect 0 python snippet.py
prints "0\.739.* 0\.0339"
prints "5\.24"
stop_daemon

say "without a daemon: three answers, those of the command line to the last digit it prints"
snippet 2
expect 0 python snippet.py
[ "$(wc -l <"$out")" -eq 3 ] || fail "not three answers"
cp "$out" answers
expect 0 "$bin/percuss" query --local --catalogue config/catalogue.yaml --a steel-sphere --b al-rod --speed 0.2 --json
sed -n 2p answers >second
grep -q "\"restitution\": $(cut -c 1-12 second)" "$out" || fail "another answer than percuss query --local"

say "the history of the force"
snippet 3
expect 0 python snippet.py
prints "^210\..* OK$"

say "two curves and their table"
snippet 4
expect 0 python snippet.py
prints "^al-rod 0\.6.* 1$"
prints "^al-beam .* [23]$"
prints "^al-rod  *0\.6"

say "an engine of twenty lines: impacts, one question each"
snippet 5
expect 0 python snippet.py
prints "s: 0\.31[34] m/s, e = 0\.67"
awk '/ e = / { n++ } /^Counts/ { exit index($0, "impacts=" n ", requests=" n ",") == 0 }' "$out" || fail "counts"
grep -c " e = " "$out" | grep -qx '[3-9]' || fail "not some impacts"

say "measurements: compared, and Young's modulus found"
snippet 1 "$source_dir/docs/measurements.md"
expect 0 python snippet.py
prints " 0\.5[0-9]* 0\.[67][0-9]*$"
prints "^7207[0-9.]* 7301[0-9.]*$"

say "the examples, as the page calls them"
commands "$page" bounces.py >examples.sh
expect 0 sh -eu examples.sh
prints "energy drawn: bounces.svg"
grep -q "</svg>" bounces.svg || fail "no picture"
# two contacts of one instant, each unlike the sphere alone
awk '$1 == "0.001000" { n++; if ($4 == $5) exit 1 } END { exit n != 2 }' "$out" || fail "not a group"
prints " 0\.354871 .* 0\.716[0-9] "
expect 1 python -c "import percuss; percuss.Local('nowhere.yaml')"
grep -q "nowhere.yaml" "$err" || fail "the missing file is not named"
