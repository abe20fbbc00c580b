#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# MuJoCo on the slow scale: known Delassus matrices and impact times, one request an impact, lists
# and totals alike. Skipped where MuJoCo is not installed.
. "$(dirname "$0")/../support/lib.sh"
program=$build/client/examples/mujoco/percuss_mujoco
example=$source_dir/client/examples/mujoco
[ -x "$program" ] || {
    say "MuJoCo (Debian: libmujoco-dev) is not installed: skipped"
    exit 77
}

# scene SCENE: its lines of impacts.csv
scene() {
    grep "^$1," "$work/impacts.csv"
}

# close_to ALLOWED VALUE EXPECTED
close_to() {
    echo "$2 $3" | awk -v allowed="$1" '{ d = $1 - $2; exit !(d <= allowed && -d <= allowed) }' ||
        fail "$2 is not $3 within $1"
}

say "a declared e = 0.4: matrices and times"
expect 0 "$program" --no-service --restitution 0.4 --scenes "$example/scenes" --output "$work"
cat "$out"
set -- 0.354870653 1.064243028 1.773693210
scene pendulum-hinged-bar >"$work/hinged"
[ "$(wc -l <"$work/hinged")" -eq 3 ] || fail "not three impacts"
for time in "$@"; do
    close_to 2e-9 "$(sed -n 1p "$work/hinged" | cut -d , -f 4)" "$time"
    close_to 1e-12 "$(sed -n 1p "$work/hinged" | cut -d , -f 8)" 0.4
    close_to 1e-6 "$(sed -n 1p "$work/hinged" | cut -d , -f 12)" 10.186404
    sed -i 1d "$work/hinged"
done
close_to 1e-6 "$(scene pendulum-bar-pinned-at-end | cut -d , -f 12)" 9.891843
scene two-spheres-free-bar | cut -d , -f 12 | tr ';\n' '  ' >"$work/matrix"
# 1/m + 1/M + x_i x_j / I with the model's own numbers
awk 'function near(a, b) { return a - b < 1e-6 && b - a < 1e-6 }
    { m = 1 / 0.110976; M = 1 / 0.84823; I = 0.070707
      exit !(near($1, m + M + 0.09 / I) && near($2, M + 0.135 / I) && near($3, $2) &&
             near($4, m + M + 0.2025 / I)) }' "$work/matrix" || fail "$(cat "$work/matrix")"

say "steps of 1/240 s that never go back: the touches within them"
mkdir "$work/fixed"
expect 0 "$program" --no-service --restitution 0.4 --scenes "$example/scenes" --output "$work/fixed" \
    --fixed-steps 0.0041666667 --scene pendulum-hinged-bar
# the swing's acceleration changes within a step, by some 1e-3 of gravity
grep -c ^pendulum "$work/fixed/impacts.csv" | grep -qx 3 || fail "not three impacts"
line=2
for time in 0.354870653 1.064243028 1.773693210; do
    close_to 4e-6 "$(sed -n ${line}p "$work/fixed/impacts.csv" | cut -d , -f 4)" "$time"
    line=$((line + 1))
done
expect 64 "$program" --fixed-steps 0
says "--fixed-steps: '0': a number of seconds > 0 is needed"

# a double pendulum at 50 degrees, W_nn by its two angles' M in closed form; it meets the wall some 0.06 mrad further
double_pendulum=5.542690952
close_to 1e-3 "$(scene double-pendulum-wall | cut -d , -f 12)" "$double_pendulum"

say "percussd answers: one request an impact"
printf 'catalogue: %s\n' "$example/catalogue.yaml" >"$work/percussd.yaml"
start_daemon
for how in "" total; do
    # --tolerance 1e-6: what is compared is applied to, not solved by, the two ways
    expect 0 "$program" --domain "$domain" --scenes "$example/scenes" --output "$work" \
        --tolerance 1e-6 ${how:+"--$how"}
    cat "$out"
    awk '/requests/ { if ($1 != $3 || $5 != "(0" || $9 != 0) exit 1; found++ }
        END { exit found != 6 }' "$out" || fail "not one request an impact"
    # the applied impulse is the reply's, and e of it by the engine's own matrix is the reply's
    awk -F , 'function far(a, b, d) { return a - b > d || b - a > d }
        NR > 1 && ($11 != "percuss" || far($6, $7, 1e-15) || far($8, $9, 1e-9)) { exit 1 }' \
        "$work/impacts.csv" || fail "$(cat "$work/impacts.csv")"
    cp "$work/impacts.csv" "$work/impacts-${how:-list}.csv"
    cp "$work/pendulum-free-bar.csv" "$work/free-${how:-list}.csv"
    # friction, of free bodies and of a double pendulum: MuJoCo's own masses and joints lose what the service's books
    # say. Free bodies at once to the digits that are printed; in a list the ball slides on meanwhile. The pendulum's
    # joints accelerate the gap by some 1 m/s^2, which does work in the books for 0.15 ms at 0.109 N s: 8e-6 J of 2e-3
    for scene in "spinning-sphere-free-bar:${how:+1e-11}" double-pendulum-wall:1e-5; do
        sed -n "/^${scene%:*}/,/requests/p" "$out" >"$work/printed"
        lost=$(sed -n 's/.*the rigid bodies lose \([^ ]*\) J.*/\1/p' "$work/printed")
        taken=$(sed -n 's/.*the impulses took \([^ ]*\) J.*/\1/p' "$work/printed")
        [ "${lost%.*}" = 0 ] || fail "no friction: $(cat "$work/printed")"
        allowed=${scene#*:}
        close_to "${allowed:-1e-6}" "$taken" "$lost"
    done
    # the pendulum's rate after by both impulses and its W in closed form: Hertz gives it back but for waves in the wall
    along=$(sed -n 's/.*tangential impulse \([^ ]*\) N s.*/\1/p' "$work/printed")
    scene double-pendulum-wall | awk -F , -v along="$along" -v w="$double_pendulum" -v across=3.448776236 '{
        e = (w * $6 + across * along) / -$5 - 1; exit !(along > 0.099 * $6 && e > 0.99 && e < 1) }' ||
        fail "e of the double pendulum: $(cat "$work/printed")"
done

say "lists and totals: the same answer, and velocities within 1e-3 of the approach afterwards"
# the second approach in the swinging scene is the return from the first impact
second() {
    grep '^pendulum-hinged-bar,2,0,' "$1" | cut -d , -f 5
}
close_to 2e-4 "$(second "$work/impacts-list.csv")" "$(second "$work/impacts-total.csv")"
last_energy() {
    tail -n 1 "$1" | cut -d , -f 2
}
close_to 1e-7 "$(last_energy "$work/free-list.csv")" "$(last_energy "$work/free-total.csv")"
# what the vibration took stays below what came: 0.110976 kg at 0.2 m/s
tail -n 1 "$work/free-list.csv" | awk -F , '{ exit !($2 < 0.00222 && $2 > 0.0005) }' || fail "energy"
stop_daemon

say "run.sh for a user"
expect 0 sh "$example/run.sh" "$build" "$work/run"
shows "MuJoCo alone, default contact: e = 0.13"
[ -s "$work/run/sub_impacts.csv" ] || fail "no sub-impacts"
[ -s "$work/run/pendulum-hinged-bar.svg" ] || fail "no plot"
peak=$(awk -F, '$1 == "pendulum-hinged-bar" && $7 > p { p = $7 } END { print p }' "$work/run/sub_impacts.csv")
gnuplot -e "folder='$work/run'; scene='pendulum-hinged-bar'; format='pdf'; load '$example/plot.gp'; \
    if (GPVAL_Y_MAX < $peak || GPVAL_Y_MIN > 0) { exit status 1 }" 2>"$err" || fail "no axis for $peak N"
[ "$(head -c 4 "$work/run/pendulum-hinged-bar.pdf")" = %PDF ] || fail "no PDF"
