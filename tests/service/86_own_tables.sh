#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# However a daemon is started, the solver in process answers the same by the same contact tables.
. "$(dirname "$0")/lib.sh"

cat >"$work/bench.yaml" <<YAML
materials:
  steel:  {young: 210e9, poisson: 0.30, density: 7800}
  al-150: {young: 70e9, poisson: 0.33, density: 2700, yield: 150e6}
bodies:
  ball:   {shape: sphere, material: steel, radius: 10mm}
  soft:   {shape: sphere, material: al-150, radius: 10mm}
  rod:    {shape: rod, material: al-150, radius: 10mm, length: 1}
YAML
cp -r "$source_dir/config/tables" "$work/tables"

# start TREE [ARGUMENT...]: the daemon of a build or an installed tree
start() {
    program=$1/bin/percussd
    [ -x "$program" ] || program=$1/sbin/percussd
    shift
    : >"$log"
    "$program" --domain "$domain" "$@" 2>>"$log" 9>&- &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "the daemon is not ready after 20 s"
    logged 'ready: domain' || fail "the daemon did not start"
}

# asked COMMAND...: the replies, without what differs from one asking to the next
asked() {
    for partner in $partners; do
        # several words
        # shellcheck disable=SC2086
        expect 0 "$@" --a ${partner%,*} --b ${partner#*,} --speed 0.5 --json
        numbers "$out" | sed -e '/"client":/d' -e '/"server":/d' -e '/"queue":/d' -e '/"solve":/d' -e '/"sequence":/d'
    done
}

# same_both_ways TREE [ARGUMENT...]: a daemon started so and the solver in process with the same arguments
same_both_ways() {
    tree=$1
    shift
    start "$tree" "$@"
    asked "$tree/bin/percuss" query --domain "$domain" >"$work/by-daemon"
    cp "$log" "$work/log.way"
    stop_daemon
    asked "$tree/bin/percuss" query --local "$@" >"$work/in-process"
    diff "$work/by-daemon" "$work/in-process" >"$out" || fail "the answers differ: $*"
    [ "$(field contact_model "$work/by-daemon")" = "${model:-table}" ] ||
        fail "contact model $(field contact_model "$work/by-daemon"): $*"
}

every_way() {
    partners="steel-sphere,al-rod-1 steel-sphere,al-beam"
    same_both_ways "$1"
    partners="ball,rod soft,rod"
    same_both_ways "$1" --catalogue "$work/bench.yaml"
    grep -q "tables: [2-9].* and the family" "$work/log.way" || fail "the log does not say which tables"
    printf '%s\n' "catalogue: bench.yaml" "tables: tables" >"$work/full.yaml"
    same_both_ways "$1" --config "$work/full.yaml"
    printf '%s\n' "catalogue: none.yaml" "tables: tables" >"$work/other.yaml"
    same_both_ways "$1" --config "$work/other.yaml" --catalogue "$work/bench.yaml"
}

say "from a build tree: without arguments, --catalogue, --config, both"
every_way "$build"

say "installed: the same"
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
every_way "$work/prefix"
