#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Ensembles: progress, samples, the same bytes from any number of workers, cancel, deadline, gone clients.
. "$(dirname "$0")/../support/lib.sh"

ensemble() {
    percuss ensemble --a steel-sphere --b al-beam --speed uniform:0.089:0.411 "$@"
}

# without what differs from one server to the next
bare() {
    numbers "$1" | sed '/"server":/d'
}

idle() {
    percuss status --json >"$work/status" 2>&1 && grep -q '"progress": null' "$work/status"
}

busy() {
    percuss status --json >"$work/status" 2>&1 && grep -q '"activity": "ensemble: ' "$work/status"
}

settings "workers: 1" "drain_seconds: 2"
start_daemon

say "a thousand samples with progress, as a table and one by one"
expect 0 ensemble --samples 1000 --progress --csv "$work/samples.csv"
says "1000/1000"
shows "restitution"
shows "sub-impacts"
[ "$(wc -l <"$out")" -le 7 ] || fail "more than the title and six lines"
[ "$(sed -n 's/^  \([a-z-]*\) .*/\1/p' "$out" | tr '\n' ' ')" = "restitution spread sub-impacts cause samples more " ] ||
    fail "not the six lines"
expect 0 ensemble --samples 64 -v
shows "skewness"
[ "$(wc -l <"$out")" -gt 40 ] || fail "not all that is known"
[ "$(wc -l <"$work/samples.csv")" -eq 1001 ] || fail "not 1000 samples in the file"
head -n 1 "$work/samples.csv" | grep -q '^speed,restitution,' || fail "no head line"

say "one that is done at once says so"
# its reply overtakes what is told on the way, now and then
for i in $(seq 20); do
    expect 0 ensemble --samples 10 --progress
    says "10/10"
done

say "a picture changes no number"
expect 0 ensemble --samples 1000 --json
numbers "$out" >"$work/plain"
expect 0 ensemble --samples 1000 --json --plot "$work/ensemble.png"
numbers "$out" >"$work/drawn"
cmp -s "$work/plain" "$work/drawn" || fail "asking for a picture changes the reply"
[ "$(od -An -tx1 -N8 "$work/ensemble.png" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG"
[ "$(wc -c <"$work/ensemble.png")" -ge 30000 ] || fail "hardly anything is drawn"
expect 0 ensemble --samples 1 --plot "$work/one.svg"
grep -q '</svg>' "$work/one.svg" || fail "no SVG"
expect 2 ensemble --plot "$work/ensemble.jpg"
says ".png, .svg or .pdf"

say "what the models are wrong by: one speed is a distribution where a sequence amplifies it"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed 0.287 --model-error --samples 200 --json
grep -q '"input": "model-compliance"' "$out" || fail "no sensitivity to the compliance"
awk -v d="$(field standard_deviation)" 'BEGIN { exit !(d > 0.01) }' || fail "deviation $(field standard_deviation)"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed 0.2 --model-error --samples 200 --json
awk -v d="$(field standard_deviation)" 'BEGIN { exit !(d > 0 && d < 0.002) }' || fail "deviation $(field standard_deviation)"
expect 5 percuss ensemble --a steel-sphere --b al-beam --speed 0.2 --input model-force=9 --samples 10
says "must be -6 to 6 standard deviations"

say "a block that a slow blow leaves rigid vibrates under a fast one, in one process as in many"
cat >"$work/block.yaml" <<'END'
materials:
  glass: {young: 70e9, poisson: 0.22, density: 2500, yield: none}
bodies:
  ball: {shape: sphere, material: glass, radius: 5 mm}
  block: {shape: block, material: glass, size: [40 mm, 40 mm, 40 mm], damping: 0.01}
END
expect 0 percuss ensemble --local --catalogue "$work/block.yaml" --a ball --b block --speed uniform:0.05:3 \
    --samples 128 --csv "$work/block.csv"
awk -F, 'NR > 1 && $1 > 1 { fast++; if ($2 > 0.99999) rigid++ } END { exit !(fast > 60 && rigid == 0) }' \
    "$work/block.csv" || fail "fast blows leave the block rigid"

say "what does not vary is a value, not a distribution"
expect 0 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 --samples 16
grep -q '^  restitution 0\.[0-9]* from each of 16 samples: it does not vary$' "$out" || fail "no value"
grep -q 'skewness\|nan\|inf\|Beta\|deviations\|#' "$out" && fail "nonsense about no spread"
expect 0 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 --samples 16 --json
[ "$(field skewness)" = null ] || fail "skewness $(field skewness)"
[ "$(field standard_deviation)" = 0.0 ] || fail "deviation $(field standard_deviation)"
[ "$(field lowest)" = "$(field mean)" ] || fail "the mean $(field mean) is not the value $(field lowest)"
grep -q '"bin_counts": \[\]' "$out" || fail "bins without a width"
expect 0 percuss ensemble --a steel-sphere --b al-rod-1 --speed 0.3 --samples 16 --plot "$work/equal.svg"
grep -q '</svg>' "$work/equal.svg" || fail "no SVG"
expect 0 ensemble --samples 1
shows "from a single sample"

say "wrong inputs are explained"
expect 2 ensemble --input young=normal:1
says "normal:MEAN:DEVIATION"
expect 5 ensemble --input young=normal:70e9:1e9
says "inputs[1].body"
expect 5 ensemble --input "colour@al-beam=1"
says "must be one of speed"
expect 2 ensemble --input "young@al-beam=list:$work/none.csv"
says "No such file"
expect 2 ensemble --input speed=0.3
says "--speed: given twice"
expect 0 ensemble --samples 20
grep -v "samples  " "$out" >"$work/by_option"
expect 0 percuss ensemble --a steel-sphere --b al-beam --input speed=uniform:0.089:0.411 --samples 20
grep -v "samples  " "$out" | cmp - "$work/by_option" || fail "--input speed= is another input than --speed"
expect 0 "$peers/wire_ensembles" "$domain"
cat "$out"

say "two workers, and another daemon: the same bytes"
for sampling in plain latin-hypercube sobol; do
    expect 0 ensemble --samples 600 --sampling "$sampling" --input young@al-beam=normal:70e9:1e9 \
        --seed 7 --json
    bare "$out" >"$work/one-$sampling"
    for bound in first_order_low first_order_high total_low total_high within_low within_high; do
        grep -q "\"$bound\": [01]" "$work/one-$sampling" || fail "$sampling: no $bound"
    done
done
stop_daemon
settings "workers: 2" "drain_seconds: 2"
start_daemon
for sampling in plain latin-hypercube sobol; do
    expect 0 ensemble --samples 600 --sampling "$sampling" --input young@al-beam=normal:70e9:1e9 \
        --seed 7 --json
    bare "$out" >"$work/two-$sampling"
    cmp -s "$work/one-$sampling" "$work/two-$sampling" ||
        fail "$sampling: $(diff "$work/one-$sampling" "$work/two-$sampling" | head -n 6)"
done

say "one impact, with the speed known to a millimetre a second"
expect 0 query --speed-sigma 0.001
shows "with the speed known to -+ 0.001 m/s"
expect 0 query --speed-sigma 0.001 --json
grep -q '"spread": {' "$out" || fail "no spread"

say "enough samples are enough"
expect 0 ensemble --samples 100000 --half-width 0.02 --json
samples=$(sed -n 's/^ *"samples": \([0-9]*\),$/\1/p' "$out")
[ "$samples" -eq 512 ] || [ "$samples" -eq 1024 ] || fail "$samples samples for -+ 0.02"

say "a list is walked through"
printf 'speed,e\n0.3,1\n0.2,1\n' >"$work/list.csv"
expect 0 percuss ensemble --a steel-sphere --b al-beam --speed "list:$work/list.csv:speed" \
    --csv "$work/samples.csv"
cut -d, -f1 "$work/samples.csv" | tr '\n' ' ' | grep -q '^speed 0.29999.* 0.20000' ||
    fail "not the list: $(cat "$work/samples.csv")"

say "a deadline cuts it short, with what there is"
expect 1 ensemble --samples 2000000 --deadline 5 --json
[ "$(field status)" = TRUNCATED ] || fail "status $(field status)"
grep -q '"message": "options.deadline: 5 s: has passed: [0-9]* of 2000000 samples were solved"' "$out" ||
    fail "$(field message)"

say "while one runs, impacts are answered"
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam \
    --speed uniform:0.089:0.411 --samples 2000000 --json >"$work/long" 2>"$err" 9>&- &
others=$!
wait_for 10 busy || fail "the status does not tell of it"
expect 0 query

say "another client's runs beside it"
expect 0 ensemble --samples 100
kill -0 "$others" || fail "the long one has ended"

say "a fourth one waits, and hears so"
for i in 2 3; do
    "$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam \
        --speed uniform:0.089:0.411 --samples 2000000 >/dev/null 2>"$work/beside-$i" 9>&- &
    beside="${beside:-} $!"
done
long=$others
others="$others $beside"
sleep 2
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam --timeout 3 --progress \
    --speed uniform:0.089:0.411 --samples 100 >"$work/second" 2>"$work/waiting" 9>&- &
second=$!
sleep 4
is_gone "$second" && fail "it does not wait"

say "interrupted, it says what was found so far"
kill -INT "$long"
code=0
wait "$long" || code=$?
others=$beside
[ "$code" -eq 1 ] || fail "exit code $code"
grep -q '"message": "cancelled: [0-9]* of 2000000 samples were solved"' "$work/long" ||
    fail "$(cat "$work/long" "$err")"
wait "$second" || fail "the one that waited: $(cat "$work/waiting")"
grep -q '0/100' "$work/waiting" || fail "it heard nothing: $(cat "$work/waiting")"
# shellcheck disable=SC2086
kill -INT $beside
for child in $beside; do
    wait "$child" || true
done
others=
wait_for 5 idle || fail "it goes on"

say "one whose client is gone is dropped"
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam \
    --speed uniform:0.089:0.411 --samples 2000000 >"$work/long" 2>"$err" 9>&- &
others=$!
wait_for 10 busy || fail "the status does not tell of it"
kill -KILL "$others"
wait "$others" 2>/dev/null || true
others=
wait_for 10 idle || fail "it goes on without its client"

say "the end of the daemon ends it, with what there is"
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam \
    --speed uniform:0.089:0.411 --samples 2000000 --json >"$work/long" 2>"$err" 9>&- &
others=$!
wait_for 10 busy || fail "the status does not tell of it"
kill -TERM "$daemon"
code=0
wait "$others" || code=$?
others=
[ "$code" -eq 1 ] || fail "exit code $code: $(cat "$err")"
grep -q '"message": "cancelled' "$work/long" || fail "$(cat "$work/long")"
wait_for 20 is_gone "$daemon" || fail "it does not end"
logged "error" && fail "an error is logged"
exit 0
