#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# SIGHUP: a good catalogue comes into force, a bad one changes nothing.
. "$(dirname "$0")/../support/lib.sh"

revision() {
    expect 0 percuss status
    sed -n 's/.*revision \([0-9a-f]*\).*/\1/p' "$out"
}

# reload LINE: sends the signal and waits for a new line in the log
reload() {
    : >"$log"
    kill -HUP "$daemon"
    wait_for 10 logged "$1" || fail "the log does not say $1"
}

lists() {
    percuss bodies >"$out" 2>"$err" && grep -q "^$1 " "$out"
}

lists_not() {
    percuss bodies >"$out" 2>"$err" && ! grep -q "^$1 " "$out"
}

start_daemon
before=$(revision)

say "a new body can be asked about"
expect 5 percuss query --a small-sphere --b al-beam --speed 0.3
echo '  small-sphere: {shape: sphere, material: steel, radius: 0.010}' >"$work/body"
sed -i "/^bodies:/r $work/body" "$work/catalogue.yaml"
reload "reload: [0-9]* bodies"
wait_for 10 lists small-sphere || fail "it is not announced"
expect 0 percuss query --a small-sphere --b al-beam --speed 0.3
after=$(revision)
[ "$before" != "$after" ] || fail "the revision did not change"

say "a bad catalogue is refused with file and line, and the old one stays"
cp "$work/catalogue.yaml" "$work/good.yaml"
sed -i 's/radius: 0.010}$/radius: -1}/' "$work/catalogue.yaml"
reload "error.*catalogue.yaml:[0-9]*: bodies.*the old catalogue stays"
expect 0 percuss query --a small-sphere --b al-beam --speed 0.3
[ "$(revision)" = "$after" ] || fail "the revision changed"
sed "/^  al-rod-1:/q" "$work/good.yaml" >"$work/catalogue.yaml"
reload "begin: stands without end.*the old catalogue stays"
: >"$work/catalogue.yaml"
reload "the old catalogue stays"
rm "$work/catalogue.yaml"
reload "the old catalogue stays"
expect 0 percuss query --a small-sphere --b al-beam --speed 0.3

say "a removed body is withdrawn, and the first revision is back"
sed '/small-sphere/d' "$work/good.yaml" >"$work/catalogue.yaml"
reload "reload: [0-9]* bodies"
wait_for 10 lists_not small-sphere || fail "it is still announced"
expect 5 percuss query --a small-sphere --b al-beam --speed 0.3
[ "$(revision)" = "$before" ] || fail "the same catalogue has another revision"

say "states of one revision are unknown to the next"
expect 0 query --json
token=$(sed -n 's/^ *"state": "\([0-9a-f]\{32\}\)"$/\1/p' "$out")
cp "$work/good.yaml" "$work/catalogue.yaml"
reload "reload: [0-9]* bodies"
cat >"$work/request.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "al-beam", "state": "$token"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
expect 5 percuss query --request "$work/request.json"
says "catalogue revision"

say "reloads while requests run lose none"
"$peers/wire_clients" "$domain" >"$work/clients" 2>&1 9>&- &
others=$!
for i in 1 2 3 4 5 6; do
    sleep 0.2
    if [ $((i % 2)) -eq 0 ]; then
        cp "$work/good.yaml" "$work/catalogue.yaml"
    else
        sed '/small-sphere/d' "$work/good.yaml" >"$work/catalogue.yaml"
    fi
    kill -HUP "$daemon"
done
wait "$others" || fail "$(cat "$work/clients")"
others=
stop_daemon

say "a list of bodies is of one catalogue, also while it is read again"
for radius in 0.01 0.02; do
    {
        echo "materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}"
        echo "friction: [{between: [steel, steel], coefficient: $radius}]"
        echo "bodies:"
        seq 400 | sed "s/.*/  ball-&: {shape: sphere, material: steel, radius: $radius}/"
        [ "$radius" = 0.01 ] || echo "  more: {shape: sphere, material: steel, radius: $radius}"
    } >"$work/catalogue-$radius"
done
cp "$work/catalogue-0.01" "$work/catalogue.yaml"
start_daemon
"$peers/whole_lists" "$domain" 4 >"$work/lists" 2>&1 9>&- &
others=$!
for i in 1 2 3 4 5 6 7 8 9 10; do
    sleep 0.3
    cp "$work/catalogue-0.0$((1 + i % 2))" "$work/catalogue.yaml"
    kill -HUP "$daemon"
done
wait "$others" || fail "$(cat "$work/lists")"
others=
cat "$work/lists"
stop_daemon
