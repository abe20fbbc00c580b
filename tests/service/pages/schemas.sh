#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A program reads and writes JSON by the schemas alone: a validator that is not ours agrees with what is
# printed, and refuses the requests that percuss refuses.
. "$(dirname "$0")/../support/lib.sh"
python3 -c 'import jsonschema' 2>/dev/null || {
    echo "python3-jsonschema is not there: skipped"
    exit 77
}
for kind in request reply ensemble sweep compare calibrate bodies remarks dents status ping doctor query; do
    "$bin/percuss" schema "$kind" >"$work/$kind.schema"
done

# valid KIND FILE
valid() {
    python3 "$source_dir/tests/reference/validate.py" "$work/$1.schema" "$2" 2>"$err"
}

# printed KIND EXIT_CODE COMMAND ARGUMENT...: what percuss prints is of that kind
printed() {
    kind=$1
    code_wanted=$2
    shift 2
    expect "$code_wanted" percuss "$@" --json
    valid "$kind" "$out" || fail "not as its schema: percuss $*"
}

# example FILE BEGIN END: what stands between two lines that begin so
example() {
    awk -v begin="$2" -v end="$3" 'index($0, end) == 1 { inside = 0 } inside { print } index($0, begin) == 1 { inside = 1 }' "$1"
}

settings "store: dents.db"
start_daemon

say "the requests of the man page and of the page are answered"
example "$source_dir/client/man/percuss.1" '.Bd -literal' .Ed | sed -n '/^{"bodies"/,$p' >"$work/man.json"
# shellcheck disable=SC2016
example "$source_dir/docs/reference/requests.md" '```json' '```' >"$work/page.json"
for file in man page; do
    valid request "$work/$file.json" || fail "the request of the $file is none"
    printed reply 0 query --request "$work/$file.json"
    numbers "$out" >"$work/$file.reply"
done
cmp "$work/man.reply" "$work/page.reply" || fail "they are not the same request"

say "what every command prints is what its schema says"
printed reply 0 query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar-1
printed reply 0 query --a steel-sphere --b steel-wall --speed 0.3
printed reply 5 query --a steel-sphere --b nobody --speed 0.3
printed ensemble 0 ensemble --a steel-sphere --b al-beam --speed uniform:0.09:0.4 --samples 256
printed query 0 query --a steel-sphere --b al-rod-1 --speed 0.2 --speed 0.3 --contact-model auto --contact-model hertz
printed sweep 0 sweep --a steel-sphere --b al-rod --speed 0.1:0.3:3
printed sweep 0 sweep --a steel-sphere --b al-rod --b al-beam --speed 0.1:0.3:2
printed compare 0 compare "$source_dir/client/examples/measured/beam.csv" --a steel-sphere --b al-beam
printed calibrate 0 calibrate "$source_dir/client/examples/measured/beam.csv" --a steel-sphere --b al-beam \
    --fit young:al-beam
printed bodies 0 bodies
printed remarks 0 bodies --check
printed dents 0 dents
printed status 0 status
printed ping 0 ping
printed doctor 0 doctor

say "and nothing else is: a member more, one less, another type"
percuss bodies --json >"$work/bodies.json"
sed 's/"id":/"name":/' "$work/bodies.json" >"$work/other.json"
! valid bodies "$work/other.json" || fail "a body without id is valid"
sed 's/"mass": [0-9.e+-]*/"mass": "heavy"/' "$work/bodies.json" >"$work/other.json"
! valid bodies "$work/other.json" || fail "a mass in words is valid"

say "percuss and the validator refuse the same requests"
# verdict EXIT_CODE VALID SED_SCRIPT: of the page's request, changed
verdict() {
    sed "$3" "$work/page.json" >"$work/changed.json"
    ! cmp -s "$work/page.json" "$work/changed.json" || fail "nothing is changed by $3"
    expect "$1" percuss query --request "$work/changed.json" --json
    is_valid=no
    ! valid request "$work/changed.json" || is_valid=yes
    [ "$is_valid" = "$2" ] || fail "valid: $is_valid, after $3"
}
verdict 0 yes 's/1e-4/0/'
verdict 0 yes 's/"hertz"/"auto"/'
verdict 0 yes 's/, "options".*}}/}/; s/"tolerance": 1e-4, //'
verdict 2 no 's/"id": "al-beam"/"name": "al-beam"/'
verdict 2 no 's/"hertz"/"hetrz"/'
verdict 2 no 's/1e-4/"small"/'
verdict 5 no 's/1e-4/5/'
verdict 2 no 's/"a": 0/"a": -1/'
verdict 2 no 's/"a": 0/"a": 0.5/'
verdict 2 no 's/\[0, 0, 1\]/[0, 1]/'
verdict 2 no 's/\[0, 0, -0.3\]/[0, null, -0.3]/'
verdict 2 no 's/"young"/"colour"/'
verdict 2 no 's/^{/{"when": 3, /'
verdict 2 no 's/^{/{"client": "me", /'
verdict 2 no 's/^{/{"sequence": 0, /'
stop_daemon
