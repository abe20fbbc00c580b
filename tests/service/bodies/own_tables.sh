#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# However a daemon is started, the solver in process answers the same by the same contact tables; and tables
# of one's own, made by the command that a warning names, stand beside the shipped ones.
. "$(dirname "$0")/../support/lib.sh"

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
mkdir "$work/empty"

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
    grep -q "tables: [2-9].* and the family" "$work/log.way" || fail "the log does not say which tables"
    partners="ball,rod soft,rod"
    same_both_ways "$1" --catalogue "$work/bench.yaml"
    grep -q "tables: [2-9].* and the family" "$work/log.way" || fail "the log does not say which tables"
    cp "$work/by-daemon" "$work/by-catalogue"
    printf '%s\n' "catalogue: bench.yaml" "tables: tables" >"$work/full.yaml"
    same_both_ways "$1" --config "$work/full.yaml"
    sed '/percuss-tables/d' "$work/by-daemon" >"$work/one"
    sed '/percuss-tables/d' "$work/by-catalogue" | cmp - "$work/one" ||
        fail "--catalogue and the same in settings differ"
    printf '%s\n' "catalogue: none.yaml" "tables: [empty, tables]" >"$work/other.yaml"
    same_both_ways "$1" --config "$work/other.yaml" --catalogue "$work/bench.yaml"
    sed '/percuss-tables/d' "$work/by-daemon" | cmp - "$work/one" || fail "with a list of folders it differs"
    # one's own folder alone takes nothing away
    printf '%s\n' "catalogue: bench.yaml" "tables: empty" >"$work/own.yaml"
    same_both_ways "$1" --config "$work/own.yaml"
    # but for the folder that a warning names
    sed '/percuss-tables/d' "$work/by-daemon" >"$work/one"
    sed '/percuss-tables/d' "$work/by-catalogue" | cmp - "$work/one" || fail "the shipped family is lost"
    # none, and those of a folder alone
    echo "catalogue: bench.yaml" >"$work/plain.yaml"
    model=closed-form
    same_both_ways "$1" --config "$work/plain.yaml"
    grep -q "tables: none" "$work/log.way" || fail "the log does not say that there are none"
    echo "tables: empty" >>"$work/plain.yaml"
    echo "tables_alone: true" >>"$work/plain.yaml"
    same_both_ways "$1" --config "$work/plain.yaml"
    model=
}

say "from a build tree: without arguments, --catalogue, --config, both"
every_way "$build"

say "installed: the same"
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
every_way "$work/prefix"
[ -x "$work/prefix/bin/percuss-tables" ] || fail "percuss-tables is not among an ordinary user's commands"

# remedy: the command of the last warning
remedy() {
    sed -n 's/.*warning: contacts.*no table of.* of the restitution, a part of the models. own error: \(.*\) makes one, which.*/\1/p' "$err" >"$work/remedy"
    [ "$(wc -l <"$work/remedy")" = 1 ] || fail "no remedy is told"
}

# the file and its folder have a blank, and the folder is not there
unset PERCUSS_TABLES
mkdir "$work/my parts"
cp "$work/bench.yaml" "$work/my parts/bench.yaml"
for way in "$build" "$work/prefix"; do
    say "the warning's command, pasted elsewhere, makes the table that the next start uses: $way"
    XDG_DATA_HOME=$work/data\ of\ ${way##*/}
    export XDG_DATA_HOME
    cd "$work/my parts"
    ask() {
        expect 0 "$way/bin/percuss" query --local --catalogue bench.yaml --a soft --b rod --speed 0.5
    }
    ask
    remedy
    (cd / && expect 0 sh -c "$(cat "$work/remedy")")
    ls "$XDG_DATA_HOME"/percuss/tables/*.json >"$out" || fail "it is not where a user's own are"
    ask
    [ ! -s "$err" ] || fail "it is still warned of"
    start "$way" --catalogue bench.yaml
    logged "tables: 1 from $XDG_DATA_HOME/percuss/tables" || fail "the log does not tell of it"
    percuss query --a soft --b rod --speed 0.5 >"$out" 2>"$err"
    [ ! -s "$err" ] || fail "the daemon still warns"
    # all other metals have what they had
    expect 0 percuss query --a ball --b rod --speed 0.5 --json
    [ "$(field contact_model)" = table ] || fail "model $(field contact_model)"
    [ "$(field restitution)" = "$(field restitution "$work/by-catalogue")" ] || fail "e = $(field restitution)"
    stop_daemon
done
cd "$work"

say "settings without tables: what the command makes has to be named there, and the warning says how"
echo "catalogue: bench.yaml" >"$work/plain.yaml"
PERCUSS_TABLES=$work/mine
export PERCUSS_TABLES
expect 0 "$bin/percuss" query --local --config "$work/plain.yaml" --a soft --b rod --speed 0.5
remedy
key=$(sed -n 's/.*uses with `\(tables: .*\)` in its settings.*/\1/p' "$err")
expect 0 sh -c "$(cat "$work/remedy") --resolution 6"
echo "$key" >>"$work/plain.yaml"
expect 0 "$bin/percuss" query --local --config "$work/plain.yaml" --a soft --b rod --speed 0.5
[ ! -s "$err" ] || fail "it is still warned of"

say "faster than tables are for by themselves: the command says so"
PERCUSS_TABLES=$work/nowhere
expect 0 "$bin/percuss" query --local --catalogue "$work/bench.yaml" --a soft --b soft --speed 2.5
remedy
grep -q -- '--speed 3 ' "$work/remedy" || fail "no speed: $(cat "$work/remedy")"

say "a service's own are in its folder for state"
unset PERCUSS_TABLES
STATE_DIRECTORY=$work/state:/nowhere
export STATE_DIRECTORY
expect 0 "$build/bin/percuss-tables" --catalogue "$work/bench.yaml" --a soft --b rod --speed 0.5 --resolution 6
shows "$work/state/tables/"
unset STATE_DIRECTORY

say "what a list may hold"
refused() {
    printf '%s\n' "catalogue: bench.yaml" "tables: $1" >"$work/list.yaml"
    expect 1 "$bin/percussd" --config "$work/list.yaml" --check-config
    says "list.yaml:2: tables: "
    says "must be the path of a folder, or a list of 1 to 8 of them"
}
refused "[]"
refused "{a: b}"
refused "[a, [b]]"
refused "[a, a, a, a, a, a, a, a, a]"
printf '%s\n' "catalogue: bench.yaml" "tables: [tables, nowhere]" >"$work/list.yaml"
expect 1 "$bin/percussd" --config "$work/list.yaml" --check-config --domain "$domain"
says "nowhere: cannot be read"
expect 2 env -u HOME -u XDG_DATA_HOME PERCUSS_TABLES= "$bin/percuss-tables" --catalogue "$work/bench.yaml"
says "--folder DIR must be given"
