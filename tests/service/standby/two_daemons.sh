#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Two daemons in one domain, with different catalogues: a client stays with one of them and says which.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
say "a request that names a server is answered by no other"
expect 0 "$peers/wire_servers" "$domain"
expect 0 percuss status --json
elder=$(field server)
expect 0 query --json
cp "$out" "$work/elder"

# start_foreign MODE, stop_foreign: another server, as tests/service/wire_foreign.c says
start_foreign() {
    : >"$work/foreign"
    "$peers/wire_foreign" "$domain" "$1" >"$work/foreign" 2>&1 9>&- &
    others=$!
    wait_for 20 grep -q there "$work/foreign" || fail "$(cat "$work/foreign")"
}
stop_foreign() {
    kill -KILL $others
    wait $others 2>/dev/null || true
    others=
}

say "one that answers before it has said since when it is up may be the one up longest"
# sooner or later: a client on a busy machine pings less often
asks_late() {
    start_foreign late
    # until it and the daemon have found each other; then nothing but the pings decides
    sleep 0.5
    code=0
    query --timeout 1 >"$out" 2>"$err" || code=$?
    stop_foreign
    [ "$code" = 4 ] && grep -q "asked is percussd 5e5e5e5e" "$err"
}
left=5
until asks_late; do
    left=$((left - 1))
    [ "$left" -gt 0 ] || fail "exit code $code: the younger one was asked each time"
done

say "what another one writes of its own accord gets into no trace and no ensemble"
expect 0 query --trace "$work/quiet.csv"
start_foreign loud
expect 0 query --trace "$work/loud.csv"
cmp -s "$work/quiet.csv" "$work/loud.csv" || fail "another trace"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 4000 --progress \
    --csv "$work/samples.csv"
! grep -q 987654321 "$err" || fail "another one's progress"
[ "$(wc -l <"$work/samples.csv")" = 4001 ] || fail "$(wc -l <"$work/samples.csv") lines, not 4001"
stop_foreign

# start_second CATALOGUE: beside the first one, in a log of its own
start_second() {
    # from its folder, where the others are not
    : >"$work/second.log"
    (cd "$work" && exec "$bin/percussd" --catalogue "$1" --domain "$domain" 2>"$work/second.log" 9>&-) &
    others=$!
    wait_for 20 grep -q 'ready: domain' "$work/second.log" || fail "$(cat "$work/second.log")"
}

has_two() {
    percuss status --json >"$out" 2>"$err" && [ "$(grep -c '"server": "' "$out")" = 2 ]
}

# both_log TEXT: each daemon logs it of the other
both_log() {
    grep -q "warning percussd [0-9a-f]\{8\} (process $others on .*) answers in this domain too, $1" "$log" &&
        grep -q "warning percussd [0-9a-f]\{8\} (process $daemon on .*) answers in this domain too, $1" \
            "$work/second.log"
}

say "a second daemon of the same catalogue: both log it, and that it differs once it is another one"
cp "$work/catalogue.yaml" "$work/changing.yaml"
start_second changing.yaml
wait_for 20 both_log "with the same catalogue" || fail "no warning: $(cat "$work/second.log")"
sed 's/young: 70e9/young: 80e9/' "$work/catalogue.yaml" >"$work/changing.yaml"
kill -HUP $others
wait_for 20 both_log "with ANOTHER CATALOGUE" || fail "no warning: $(cat "$work/second.log")"
grep -q "with ANOTHER CATALOGUE: $work/changing.yaml (revision [0-9a-f]*), ours is $work/catalogue.yaml (revision [0-9a-f]*): .* outside domain $domain by --domain N or PERCUSS_DOMAIN=N" \
    "$log" || fail "the way out is not told"
kill -TERM $others
wait $others || fail "the second daemon failed"
wait_for 20 logged "percussd [0-9a-f]* (process $others on .*) has gone" || fail "it is not missed"
others=

stiff=$work/stiff.yaml
sed 's/young: 70e9/young: 90e9/' "$work/catalogue.yaml" >"$stiff"
start_second stiff.yaml
say "status lists both, the one that has been up longest first"
wait_for 20 has_two || fail "status does not list two servers"
[ "$(field server)" = "$elder" ] || fail "the elder is not the first"
younger=$(sed -n 's/^ *"server": "\([0-9a-f]*\)",*$/\1/p' "$out" | sed -n 2p)
short=$(echo "$younger" | cut -c1-12)

say "who is named answers, and all the time: other numbers by another catalogue"
for server in "$elder" "$short"; do
    for i in 1 2 3 4 5 6; do
        expect 0 query --json --server "$server"
        [ ! -s "$err" ] || fail "a chosen server is warned of"
        case $(field server) in "$server"*) ;; *) fail "answered by $(field server)" ;; esac
        field restitution >>"$work/by-$server"
    done
    [ "$(sort -u "$work/by-$server" | wc -l)" = 1 ] || fail "$(cat "$work/by-$server")"
done
[ "$(head -n 1 "$work/by-$elder")" != "$(head -n 1 "$work/by-$short")" ] || fail "the same numbers"
[ "$(head -n 1 "$work/by-$elder")" = "$(field restitution "$work/elder")" ] || fail "other numbers than before"

say "the points of a sweep, the samples of an ensemble and a trace come from one server"
expect 0 percuss sweep --a steel-sphere --b al-beam --speed 0.1:0.4:31 --json --server "$short"
[ "$(sed -n 's/^ *"server": "\(.*\)",*$/\1/p' "$out" | sort -u)" = "$younger" ] || fail "several servers"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.1:0.4 --samples 256 --json \
    --server "$short"
[ "$(field server)" = "$younger" ] || fail "answered by $(field server)"
expect 0 query --trace "$work/trace.csv" --json --server "$short"
[ "$(field server)" = "$younger" ] || fail "answered by $(field server)"
percuss ping --count 20 --server "$short" >"$out" 2>"$err" || fail "no ping"

say "who names none is told that there are two, with emphasis on the other catalogue, and who answered"
# sooner or later: a client does not wait until it has found everybody
warns() {
    expect 0 query
    grep -q "answers here too, with ANOTHER CATALOGUE" "$err"
}
wait_for 20 warns || fail "no warning"
says "$stiff); asked is percussd"
says "or give each a domain of its own (--domain N, PERCUSS_DOMAIN)"

say "a body that the one asked does not know: whose catalogue that is, who has another one, and how to ask there"
explains() {
    expect 5 percuss query --a nobody --b al-rod --speed 1
    grep -q "another catalogue" "$err"
}
wait_for 20 explains || fail "the other catalogue is not named"
says "that is the catalogue $work/catalogue.yaml of percussd $(echo "$elder" | cut -c1-8)"
says "has another catalogue, $stiff: --server $(echo "$younger" | cut -c1-8) asks it"
says "PERCUSS_DOMAIN=N"
expect 5 percuss sweep --a nobody --b al-rod --speed 0.1:0.2:2
says "that is the catalogue $work/catalogue.yaml"
expect 5 percuss ensemble --a nobody --b al-rod --speed uniform:0.1:0.2 --samples 4
says "that is the catalogue $work/catalogue.yaml"
expect 5 percuss compare "$source_dir/client/examples/measured/synthetic-beam.csv" --a nobody --b al-beam
says "that is the catalogue $work/catalogue.yaml"
say "who finds both asks the one up longest"
both=0
for i in 1 2 3 4 5 6 7 8 9 10; do
    expect 0 query --json
    # on a busy machine the elder may be found too late to be known of at all; then nobody is warned
    ! grep -q "answers here too" "$err" || both=$((both + 1))
    [ "$(field server)" = "$elder" ] || ! grep -q "answers here too" "$err" ||
        fail "answered by $(field server)"
done
[ "$both" -gt 0 ] || fail "nobody was found beside the one that answered"
expect 0 query
grep -q '^  server       [0-9a-f]\{8\}, catalogue revision [0-9a-f]\{8\}$' "$out" || fail "the table does not say who"

say "who names what is not there"
expect 3 query --server 0123456789abcdef --timeout 1
says "has an id that begins with 0123456789abcdef; there is percussd "
expect 2 query --server xyz
says "--server: 'xyz' is not 1 to 32 hexadecimal digits"

say "the domain may come from the environment"
expect 0 env PERCUSS_DOMAIN="$domain" "$bin/percuss" ping
expect 0 env PERCUSS_DOMAIN="$domain" "$build/client/examples/query"
expect 1 env PERCUSS_DOMAIN=300 "$build/client/examples/query"
says "PERCUSS_DOMAIN: '300' is not a whole number of 0..230"
expect 2 env PERCUSS_DOMAIN=300 "$bin/percuss" ping
says "PERCUSS_DOMAIN: '300' is not a whole number of 0..230"
expect 2 env PERCUSS_DOMAIN=300 "$bin/percussd" --config "$work/percussd.yaml"
says "PERCUSS_DOMAIN: 300: must be a whole number, 0 to 230"
kill -TERM $others
wait $others || fail "the second daemon failed"
others=

say "with one daemon: its catalogue, and how another domain is asked"
expect 5 percuss query --a nobody --b al-rod --speed 1
says "(process $daemon on "
says "in DDS domain $domain; a daemon of another domain is asked by --domain N or PERCUSS_DOMAIN=N"
stop_daemon
expect 5 "$bin/percuss" query --local --catalogue "$stiff" --a nobody --b al-rod --speed 1
says "that is the catalogue $stiff"
