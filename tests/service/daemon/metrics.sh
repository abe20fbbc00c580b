#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The file that a monitoring system reads: what was asked is what it counts; the dashboard and the alerts name
# what is in it; status --watch.
. "$(dirname "$0")/../support/lib.sh"

# of Debian, as the package of the parsers is
python=/usr/bin/python3
"$python" -c 'import prometheus_client' 2>/dev/null || {
    echo "python3-prometheus-client is not installed (sh deploy/dependencies.sh test)"
    exit 77
}
file=$work/percuss.prom
value() { "$python" "$support/metrics.py" "$file" value "$@"; }
is() {
    wanted=$1
    shift
    [ "$(value "$@")" = "$wanted" ]
}
replies() { is "$1" percuss_replies_total kind=request status="$2"; }

settings "metrics: $file" "store: $work/dents.db" "limits: {seconds: 0.5}"
start_daemon
wait_for 5 test -s "$file" || fail "no file"

say "what was asked is what is counted"
for speed in 0.1 0.2 0.3 0.4 0.5; do
    expect 0 percuss query --a steel-sphere --b al-rod --speed "$speed"
done
expect 0 percuss query --a steel-sphere --b al-rod --speed 0.2 --specimen-b bar
for body in one two three; do
    expect 5 percuss query --a steel-sphere --b "$body" --speed 0.2
done
expect 4 percuss query --a steel-sphere --b al-beam --speed 0.2 --method cvode --tolerance 1e-8
wait_for 5 replies 6 OK || fail "OK: $(value percuss_replies_total kind=request status=OK)"
wait_for 5 replies 3 UNKNOWN_BODY || fail "UNKNOWN_BODY"
wait_for 5 replies 1 TIMEOUT || fail "TIMEOUT"
is 0 percuss_replies_total status=INTERNAL || fail "INTERNAL"
is 6 percuss_solve_seconds_count || fail "solves"
is 6 percuss_wait_seconds_count || fail "waits"
is 6 percuss_energy_closure_ratio_count || fail "closures"
is 6 percuss_energy_closure_ratio_bucket le=0.001 || fail "energies that do not balance"
is 1 percuss_store_commit_seconds_count || fail "commits"
is 1 percuss_specimens || fail "specimens"

say "the catalogue read again, taken and refused"
kill -HUP "$daemon"
wait_for 5 is 1 percuss_catalogue_loads_total result=taken || fail "a reload is not counted"
printf 'bodies: [\n' >"$work/catalogue.yaml"
kill -HUP "$daemon"
wait_for 5 is 1 percuss_catalogue_loads_total result=refused || fail "a bad catalogue is not counted"

say "the dashboard and the alerts name what is there, and all of it"
"$python" "$support/metrics.py" "$file" known "$source_dir/deploy/monitoring/percuss-grafana.json" \
    "$source_dir/deploy/monitoring/percuss.rules.yml" || fail "other metrics"

say "each alert is in the runbook, and nothing else"
sed -n 's/.*- alert: //p' "$source_dir/deploy/monitoring/percuss.rules.yml" | sort >"$work/alerts"
sed -n 's/^## \(Percuss[A-Za-z]*\)$/\1/p' "$source_dir/docs/reference/runbook.md" | sort >"$work/pages"
cmp "$work/alerts" "$work/pages" || fail "alerts and pages differ"

say "status --watch looks again and again"
timeout -s INT 3 "$bin/percuss" status --domain "$domain" --watch=0.5 >"$out" 2>"$err" || true
[ "$(grep -c '^process' "$out")" -ge 3 ] || fail "it looks $(grep -c '^process' "$out") times"
grep -q '^rate .* answers a second$' "$out" || fail "no rate"
expect 2 percuss status --watch=0

say "a file that cannot be written is told once"
rm -rf "$work/percuss.prom"
mkdir "$work/percuss.prom"
wait_for 5 logged "error.*metrics: .*percuss.prom: cannot be written: Is a directory" || fail "not told"
sleep 2.5
[ "$(grep -c 'metrics: ' "$log")" -eq 1 ] || fail "told again"
expect 0 percuss query --a steel-sphere --b al-rod --speed 0.25
stop_daemon
