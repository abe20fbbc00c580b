#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A program reads and writes JSON by the schemas alone: a validator that is not ours agrees with what is
# printed, and refuses the requests that percuss refuses.
. "$(dirname "$0")/../support/lib.sh"
python3 -c 'import jsonschema, yaml' 2>/dev/null || {
    echo "python3-jsonschema or python3-yaml is not there: skipped"
    exit 77
}
for kind in request reply ensemble sweep compare calibrate export bodies remarks dents status ping doctor query catalogue settings; do
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

say "shipped catalogues and settings, and those of the documents, are what their schemas say"
expect 0 python3 "$source_dir/tests/reference/validate_yaml.py" --all "$work/catalogue.schema" "$work/settings.schema" "$source_dir"
for file in catalogue percussd; do
    schema=$(sed -n 's/^# yaml-language-server: $schema=//p' "$source_dir/config/$file.yaml")
    [ -s "$source_dir/config/$schema" ] || fail "$file.yaml names no schema that is there"
done

say "percussd and the validator refuse the same catalogues and settings"
cat >"$work/right.yaml" <<'END'
materials:
  brass: {young: 100 GPa, poisson: 0.34, density: 8.5 g/cm^3, yield: 200e6}
  1050: {young: 70e9, poisson: 0.33, density: 2700 kg/m3, yield: none, loss_factor: 0}
bodies:
  ball: {shape: sphere, material: brass, diameter: 0.625 in}
  arm: {shape: beam, material: 1050, section: {width: 12 mm, height: 8mm}, length: 0.2, ends: cantilever, shear_factor: cowper}
  bar: {shape: rod, material: brass, radius: 10 mm, length: 1 m, ends: [fixed, free], lateral_inertia: true}
friction: [{between: [brass, 1050], coefficient: 0.2}]
contact: {compliance: half-space}
END
printf 'domain: 3\nworkers: 2\nlimits: {seconds: 1e3}\nlog_level: debug\ntables: [a, b]\ntables_alone: true\n' >"$work/right-settings.yaml"
mkdir "$work/a" "$work/b"
mkdir "$work/catalogue" "$work/settings"
cp "$work/right.yaml" "$work/catalogue/right"
cp "$work/right-settings.yaml" "$work/settings/right"
local="$bin/percuss bodies --local --catalogue"
# words
# shellcheck disable=SC2086
{
    expect 0 $local "$work/catalogue/right"
    expect 0 $local "$work/right.yaml" --config "$work/right-settings.yaml"
}
# refused KIND SED_SCRIPT: of the right file of that kind, changed
refused() {
    count=$((count + 1))
    sed "$2" "$work/$1/right" >"$work/$1/wrong-$count"
    ! cmp -s "$work/$1/right" "$work/$1/wrong-$count" || fail "nothing is changed by $2"
    cp "$work/$1/wrong-$count" "$work/changed.yaml"
    # shellcheck disable=SC2086
    case $1 in
    catalogue) expect 2 $local "$work/changed.yaml" ;;
    settings) expect 2 $local "$work/right.yaml" --config "$work/changed.yaml" ;;
    esac
}
count=0
for change in 's/young: 100 GPa, //' 's/100 GPa/100 GPas/' 's/100 GPa/100 mm/' 's/100 GPa/-100 GPa/' 's/70e9/-3/' 's/0.34/0.5/' \
    's/8mm/8 kg/' 's/8mm/8 mm thick/' 's/sphere/spere/' 's/cantilever/loose/' 's/cowper/cooper/' 's/fixed, free/fixed/' 's/true/soft/' \
    's/shape: rod, //' 's/radius: 10 mm, //' 's/radius: 10 mm/radius: 10 mm, diameter: 20 mm/' 's/material: 1050, //' 's/length: 0.2, //' \
    's/lateral_inertia/lateral/' 's/width: 12 mm, //' 's/coefficient: 0.2/coefficient: 11/' 's/brass, 1050/brass/' 's/half-space/soft/' \
    's/loss_factor: 0/loss: 0/' 's/^materials/material/'; do
    refused catalogue "$change"
done
for change in 's/domain: 3/domain: 231/' 's/domain: 3/domain: 1.5/' 's/workers: 2/workers: 0/' 's/workers/worker/' 's/1e3/never/' \
    's/seconds/second/' 's/debug/loud/' 's/\[a, b\]/[]/' 's/alone: true/alone: 1/'; do
    refused settings "$change"
done
for kind in catalogue settings; do
    python3 "$source_dir/tests/reference/validate_yaml.py" "$work/$kind.schema" "$work/$kind"/* >"$work/valid"
    [ "$(cat "$work/valid")" = "$work/$kind/right" ] || fail "valid of the wrong ones and the right one: $(cat "$work/valid")"
done

say "the same combinations of keys, of laws and of what materials lose, pass the schema and percussd"
python3 "$source_dir/tests/reference/combinations.py" "$work/combined"
for file in "$work/combined"/*.yaml; do
    # words
    # shellcheck disable=SC2086
    ! $local "$file" >/dev/null 2>&1 || echo "$file"
done >"$work/accepted"
python3 "$source_dir/tests/reference/validate_yaml.py" "$work/catalogue.schema" "$work/combined"/*.yaml >"$work/valid"
diff "$work/accepted" "$work/valid" || fail "accepted (<) and valid (>) are not the same"
[ "$(wc -l <"$work/valid")" -gt 20 ] || fail "only $(wc -l <"$work/valid") are valid"

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
printed compare 0 compare "$source_dir/client/examples/measured/synthetic-beam.csv" --a steel-sphere --b al-beam
printed calibrate 0 calibrate "$source_dir/client/examples/measured/synthetic-beam.csv" --a steel-sphere --b al-beam \
    --fit young:al-beam
printed export 0 export --for drake --a steel-sphere --b al-rod-1 --speed 0.1:0.3:3
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
