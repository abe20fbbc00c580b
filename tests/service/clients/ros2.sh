#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-ros2 answers on topics and by a service, as the command line is answered; and goes on when the
# daemon ends and begins.
. "$(dirname "$0")/../support/lib.sh"

# start_bridge: the daemon's domain is ROS 2's too
start_bridge() {
    : >"$work/bridge.log"
    "$bin/percuss-ros2" --domain "$domain" --ros-domain "$domain" "$@" 2>"$work/bridge.log" 9>&- &
    others=$!
    bridge=$!
    wait_for 20 grep -q 'ready: domain' "$work/bridge.log" || fail "$(cat "$work/bridge.log")"
}

# restitution SPEED: by the command line
restitution() {
    cat >"$work/request.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-$1, 0, 0]}, {"id": "al-rod-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}]}
JSON
    expect 0 percuss query --request "$work/request.json" --json
    field restitution
}

# agree FILE SPEED...: the answers are those; both print all digits, and the daemon has no other ones
agree() {
    answers=$1
    shift
    number=0
    for speed in "$@"; do
        wanted=$(restitution "$speed")
        awk -v n="$number:" -v e="$wanted" '$1 == n { found = 1; d = $2 - e; exit !(d * d <= 1e-24 && e > 0) }
            END { if (!found) exit 1 }' "$answers" || fail "not $wanted at $speed: $(cat "$answers")"
        number=$((number + 1))
    done
}

say "topics and service: the answers are the command line's"
start_daemon
start_bridge
for way in topic service; do
    expect 0 "$peers/ros2_peer" "$domain" "$way" 0.1 3
    cp "$out" "$work/$way"
    agree "$work/$way" 0.1 0.2 0.3
done

say "who reads replies a moment after it has asked gets them"
expect 0 "$peers/ros2_peer" "$domain" late 0.1 3
cp "$out" "$work/late"
agree "$work/late" 0.1 0.2 0.3

say "two clients of the service at once: each gets his own answers"
"$peers/ros2_peer" "$domain" service 0.1 20 >"$work/one" 9>&- &
one=$!
expect 0 "$peers/ros2_peer" "$domain" service 0.15 20
cp "$out" "$work/two"
wait "$one" || fail "$(cat "$work/one")"
agree "$work/one" 0.1 0.2
agree "$work/two" 0.15 0.3

say "friction: the impulse with all components, of the bodies' own masses and of stated ones"
for matrix in "" 10,0.5,0,0.5,30,0,0,0,25; do
    cat >"$work/slide.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.1, 0.05, 0]}, {"id": "al-rod"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0], "friction": 0.2}]
, "delassus": [$matrix]}
JSON
    [ -n "$matrix" ] || sed -i 's/^, .*/}/' "$work/slide.json"
    expect 0 percuss query --request "$work/slide.json" --json
    tr -d ' \n' <"$out" | sed 's/.*"impulse_vector":\[\([^]]*\)\].*/\1/; s/,/ /g' >"$work/vector$matrix"
    for way in topic service; do
        expect 0 "$peers/ros2_peer" "$domain" "$way" 0.1 1 al-rod 0.2 "$matrix"
        sed -n 's/^vector //p' "$out" | cat - "$work/vector$matrix" | awk '
            NR == 1 { x = $1; y = $2; z = $3 }
            NR == 2 { exit !(x == $1 && y == $2 && z == $3 && y < -0.1 * x) }' ||
            fail "$(cat "$out"), not $(cat "$work/vector$matrix")"
    done
done
cmp -s "$work/vector" "$work/vector$matrix" && fail "the stated masses changed nothing"

say "what is wrong is answered, with the reason"
expect 0 "$peers/ros2_peer" "$domain" topic 0.1 1 nobody
shows "0: -1 4 "
shows "nobody"
expect 0 "$peers/ros2_peer" "$domain" service 0.1 1 "$(printf 'x%.0s' $(seq 70))"
shows "0: -1 2 bodies[1].id has 70 bytes, at most 63 are allowed"
expect 0 "$peers/ros2_peer" "$domain" topic -0.1 1
shows "0: -1 3 "
expect 0 "$peers/ros2_peer" "$domain" topic 0.1 1 al-rod 0.2 10,10
shows "0: -1 2 delassus: 2 numbers, 1, 9 (with both tangents) or none are allowed"
expect 0 "$peers/ros2_peer" "$domain" topic 0.1 1 al-rod 0.2 10
shows "0: -1 2 delassus: 1 x 1 numbers: where a contact has friction it must be 3 x 3"

say "questions that are cut or changed: it goes on"
expect 0 "$peers/ros2_damaged" "$domain" "${PERCUSS_DAMAGED:-3000}"
cat "$out"
kill -0 "$bridge" || fail "the bridge has ended: $(cat "$work/bridge.log")"
for way in topic service; do
    expect 0 "$peers/ros2_peer" "$domain" "$way" 0.1 3
    cp "$out" "$work/$way"
    agree "$work/$way" 0.1 0.2 0.3
done

say "without a daemon: said so; with another one: answered"
stop_daemon
expect 0 "$peers/ros2_peer" "$domain" topic 0.1 1
shows "0: -1 1000 no percussd answers in DDS domain $domain"
start_daemon
expect 0 "$peers/ros2_peer" "$domain" topic 0.1 2
cp "$out" "$work/again"
agree "$work/again" 0.1 0.2

# announced: the catalogue as it is announced is that of the command line
announced() {
    expect 0 "$peers/ros2_bodies" "$domain" "$@"
    revision=$(cat "$err")
    cp "$out" "$work/announced"
    expect 0 percuss bodies --csv
    sed 1d "$out" >"$work/listed"
    echo >>"$work/listed"
    expect 0 percuss bodies --pairs --csv
    sed 1d "$out" >>"$work/listed"
    echo >>"$work/listed"
    head -n "$(wc -l <"$work/listed")" "$work/announced" | diff "$work/listed" - || fail "listed (<) and announced (>) are not the same"
    expect 0 percuss status
    shows "$revision"
}

say "the catalogue, with what it states of materials, their pairs and places on bodies, as the command line lists it"
announced
printf '0,0\n1e-3,10\n2e-3,40\n' >"$work/press.csv"
cat >"$work/materials" <<'YAML'
  gum:  {young: 8 MPa, poisson: 0.49, density: 1100, loss_factor: 0.2, loss_frequency: 2 kHz}
  pom:  {young: 4 GPa, poisson: 0.4, density: 1410, relaxation: [{share: 0.1, time: 30 us}, {share: 0.05, time: 2 ms}]}
  mild: {young: 210 GPa, poisson: 0.3, density: 7850, yield: 250 MPa, rate: {reference: 40, exponent: 5}}
YAML
cat >"$work/bodies" <<'YAML'
  gum-ball: {shape: sphere, material: gum, radius: 0.01}
  pom-rod: {shape: rod, material: pom, radius: 0.01, length: 0.3, ends: [free, fixed], tip_radius: 0.02}
  mild-ball: {shape: sphere, material: mild, radius: 0.01}
YAML
sed -e "/^materials:/r $work/materials" -e "/^bodies:/r $work/bodies" "$work/catalogue.yaml" >"$work/more.yaml"
cat >"$work/catalogue.yaml" <<'YAML'
begin: true
laws:
  buffer: {between: [gum, mild], points: press.csv}
  stop: {between: [pom, mild], stiffness: 2e6, hysteresis: 0.3}
friction: [{between: [gum, steel], coefficient: 0.3}, {between: [pom, mild], coefficient: 0.2, deviation: 0.05}]
YAML
sed '/^begin: true/d' "$work/more.yaml" >>"$work/catalogue.yaml"
kill -HUP "$daemon"
announced "$revision"
grep -q '^gum,mild,nan,nan,buffer,points,.*,press.csv,3,' "$work/announced" || fail "$(cat "$work/announced")"
grep -q '^al-half-plate edge [^ ]* -0.0424[^ ]* [^ ]* [^ ]* -1 ' "$work/announced" || fail "$(cat "$work/announced")"
grep -q '^pom-rod 0 2$' "$work/announced" || fail "$(cat "$work/announced")"

say "other friction alone is another catalogue, too"
sed -i 's/coefficient: 0.3}/coefficient: 0.4}/' "$work/catalogue.yaml"
kill -HUP "$daemon"
announced "$revision"
grep -q '^gum,steel,0.4' "$work/announced" || fail "$(cat "$work/announced")"

say "SIGTERM ends it"
kill -TERM "$bridge"
code=0
wait "$bridge" || code=$?
others=
[ "$code" = 0 ] || fail "it ended with $code"
expect 2 env ROS_DOMAIN_ID=none "$bin/percuss-ros2"
says "ROS_DOMAIN_ID"
expect 2 "$bin/percuss-ros2" --network --domain 7 --ros-domain 7
expect 2 "$bin/percuss-ros2" --namespace a//b
stop_daemon
