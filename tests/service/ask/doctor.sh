#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss doctor says what is wrong, and what to do, of each thing that keeps a daemon from answering.
. "$(dirname "$0")/../support/lib.sh"

cat >"$work/apart.xml" <<EOF
<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces><AllowMulticast>false</AllowMulticast></General>
<Discovery><Tag>apart</Tag><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>
EOF
apart=file://$work/apart.xml

# s, for a daemon that is there
long=3
! is_sanitized || long=30

# doctor EXIT_CODE [URI]: by that CYCLONEDDS_URI
doctor() {
    expect "$1" timeout 100 env ${2:+"CYCLONEDDS_URI=$2"} "$bin/percuss" doctor --domain "$domain" --timeout "${patience:-0.5}"
    [ ! -s "$err" ] || fail "something is written to standard error"
    ! grep -v '^\(ok      \|warning \|problem \) [a-z0-9A-Z ]*: ' "$out" | grep -qv '^\(nothing is wrong\|[0-9]* problem.*\)$' ||
        fail "not a finding a line"
}
# xml TEXT: a configuration inside the variable
xml() {
    echo "<CycloneDDS><Domain Id=\"any\">$1</Domain></CycloneDDS>"
}

say "without a daemon: none, and how to start one"
doctor 3
shows "ok       domain: $domain, by --domain"
shows "ok       variables: neither PERCUSS_* nor CYCLONEDDS_URI are set"
shows "ok       configuration: CYCLONEDDS_URI is not set: the built-in one: 127.0.0.1 alone, no multicast"
# clients of other stories may look for a daemon here meanwhile
shows " of the 103 participant indices of clients are taken in the domain"
shows "ok       participants: "
shows "problem  daemon: no percussd in DDS domain $domain; "
shows "; to do: start one with: "
shows "ok       state: settings, catalogue, tables, store and its room: "

say "PERCUSS_DOMAIN is named, and where --domain goes before it"
PERCUSS_DOMAIN=$domain "$bin/percuss" doctor --timeout 0.2 >"$out" || true
shows "ok       domain: $domain, as PERCUSS_DOMAIN says"
PERCUSS_DOMAIN=7 "$bin/percuss" doctor --domain "$domain" --timeout 0.2 >"$out" || true
shows "ok       domain: $domain, by --domain; PERCUSS_DOMAIN is 7"
shows "ok       variables: PERCUSS_DOMAIN=7"

say "a configuration that cannot be used, in the words of DDS, with what to do"
doctor 3 "file://$work/none.xml"
shows "problem  configuration: CYCLONEDDS_URI=file://$work/none.xml cannot be used: can't open configuration file"
shows "; to do: name a file that is there and that this user can read, or unset CYCLONEDDS_URI"
doctor 3 "$(xml '<General><AlowMulticast>false</AlowMulticast></General>')"
shows "AlowMulticast: unknown element"
doctor 3 "$(xml '<General><Interfaces><NetworkInterface name="none0"/></Interfaces></General>')"
shows "cannot be used: none0: does not match an available interface.; to do: name one of the interfaces above"

say "one by which nobody can be found"
doctor 3 "$(xml '<General><AllowMulticast>false</AllowMulticast></General>')"
shows "problem  configuration: AllowMulticast is false and no Peer is named: DDS finds nobody; to do: name the other"

say "shared memory without its daemon"
doctor 3 "$(xml '<SharedMemory><Enable>true</Enable></SharedMemory>')"
shows "problem  configuration: "
shows "whose daemon iox-roudi is not there"
shows "problem  DDS: domain $domain cannot be joined: CYCLONEDDS_URI has SharedMemory enabled, and its daemon is not there"

if unshare -rn true 2>/dev/null; then
    say "no interface"
    expect 3 unshare -rn "$bin/percuss" doctor --domain "$domain" --timeout 0.3
    shows "problem  interfaces: 127.0.0.1 is not up"
    shows "to do: ip link set lo up (as root)"
    expect 3 env CYCLONEDDS_URI="$(xml "")" unshare -rn "$bin/percuss" doctor --domain "$domain" --timeout 0.3
    shows "problem  interfaces: none is up"
    shows "cannot be used: failed to find interfaces"
fi

if unshare -rn sh -c 'ip link add d0 type veth peer name d1' 2>/dev/null; then
    say "an interface without multicast"
    for multicast in off on; do
        env CYCLONEDDS_URI="$(xml "")" unshare -rn sh -c '
            ip link set lo up && ip link add d0 type veth peer name d1 && ip link set d1 up &&
            ip addr add 192.0.2.7/24 dev d0 && ip link set d0 multicast "$1" up && shift && exec "$@"' \
            sh "$multicast" "$bin/percuss" doctor --domain "$domain" --timeout 0.3 >"$out" 2>"$err" || true
        shows ", d0 192.0.2.7"
        code=0
        grep -q "^problem  configuration: multicast is not available from 192.0.2.7" "$out" || code=1
        [ "$code$multicast" = 0off ] || [ "$code$multicast" = 1on ] || fail "multicast is $multicast"
    done
fi

say "the files that a daemon beside the program would have"
mkdir -p "$work/usr/bin" "$work/usr/sbin" "$work/usr/share/percuss"
cp "$bin/percuss" "$work/usr/bin"
cp "$bin/percussd" "$work/usr/sbin"
printf '%s\n' "catalogue: $work/catalogue.yaml" "store: $work/missing/specimens.db" >"$work/usr/share/percuss/percussd.yaml"
expect 3 "$work/usr/bin/percuss" doctor --domain "$domain" --timeout 0.3
shows "problem  state: store: $work/missing/specimens.db: cannot be made: No such file or directory: its folder is missing"
if [ "$(id -u)" = 0 ]; then
    # what is built may lie where nobody else may look
    cp -L "$(ldd "$bin/percuss" | sed -n 's/.*=> \(.*libpercuss\.so[^ ]*\).*/\1/p')" "$work/usr/sbin"
    chmod 755 "$work"
    mkdir -m 700 "$work/closed"
    printf '%s\n' "catalogue: $work/catalogue.yaml" "store: $work/closed/specimens.db" >"$work/usr/share/percuss/percussd.yaml"
    expect 3 setpriv --reuid=65534 --regid=65534 --clear-groups env LD_LIBRARY_PATH="$work/usr/sbin" \
        "$work/usr/bin/percuss" doctor --domain "$domain" --timeout 0.3
    shows "problem  state: store: $work/closed/specimens.db: cannot be "
    shows "Permission denied; to do: give the daemon's user that right; where it is not this user: sudo -E percuss doctor"
fi
(ulimit -n 40 && "$work/usr/bin/percuss" doctor --domain "$domain" --timeout 0.3 >"$out") || true
shows "problem  state: file descriptors: 40 are allowed (ulimit -n, LimitNOFILE=): must be at least 64"
# what is to be started has another catalogue
echo "bodies: [" >"$work/usr/share/percuss/catalogue.yaml"
printf '%s\n' "catalogue: $work/usr/share/percuss/catalogue.yaml" >"$work/usr/share/percuss/percussd.yaml"
expect 3 "$work/usr/bin/percuss" doctor --domain "$domain" --timeout 0.3
shows "problem  state: $work/usr/share/percuss/catalogue.yaml:"

say "with a daemon nothing is wrong, and it is described"
settings "store: $work/specimens.db"
start_daemon
patience=$long doctor 0
shows "ok       daemon: percussd $("$bin/percuss" --version | cut -d' ' -f2) "
shows "(process $daemon on "
grep -q "^ok       participants: .* in the domain: .*percussd (process $daemon on " "$out" || fail "it is none"
shows "ok       clock: within "
shows "ok       process: percussd runs as process $daemon in this domain, with the same CYCLONEDDS_URI"
shows "nothing is wrong"
[ "$(grep -c "ok       state: " "$out")" = 1 ] || fail "its files are not looked at"

say "as JSON it is the same"
expect 0 percuss doctor --json --timeout $long
[ "$(field problems)" = 0 ] && [ "$(field level)" = ok ] && [ "$(field subject)" = version ] || fail "not the findings"

say "a configuration that it does not have is named beside its own"
doctor 3 "$apart"
shows "problem  process: percussd runs as process $daemon in this domain with CYCLONEDDS_URI not set, and here it is $apart"
shows "to do: give both the same CYCLONEDDS_URI, or unset it for both"
! grep -q "start one with" "$out" || fail "another one is to be started"

say "one that is stopped"
kill -STOP "$daemon"
doctor 3
shows "problem  process: percussd is stopped, as process $daemon in this domain"
kill -CONT "$daemon"

say "one in another domain of this machine"
elsewhere_is_named() {
    expect 3 "$bin/percuss" doctor --domain 19 --timeout 0.3
    grep -q "^warning  other domains: percussd announces itself in domain \(.*, \)\{0,1\}$domain[ ,]" "$out"
}
wait_for 10 elsewhere_is_named || fail "it is not named"

say "two with different catalogues"
sed 's/radius: 0.015/radius: 0.016/' "$work/catalogue.yaml" >"$work/other.yaml"
"$bin/percussd" --catalogue "$work/other.yaml" --domain "$domain" 2>"$work/log2" 9>&- &
others=$!
wait_for 20 grep -q "ready: domain" "$work/log2" || fail "the second one does not start"
patience=$long doctor 1
shows "warning  another daemon: percussd "
shows "answers here too, with another catalogue ("
kill "$others"
wait "$others"
others=

say "what a running daemon lacks: a folder of its metrics"
stop_daemon
settings "metrics: $work/away/percuss.prom"
start_daemon
patience=$long doctor 1
shows "warning  state: metrics: $work/away/percuss.prom: "
stop_daemon

interpose=$build/tests/libinterpose.so
if [ -e "$interpose" ] && ! is_sanitized thread; then
    say "a clock that differs"
    settings
    printf '%-16s' -3600 >"$work/clock"
    : >"$log"
    LD_PRELOAD=$(preload "$interpose") PERCUSS_FAULT_CLOCK=$work/clock "$bin/percussd" --config "$work/percussd.yaml" \
        --domain "$domain" 2>>"$log" 9>&- &
    daemon=$!
    wait_for 20 is_up_or_dead || fail "not ready"
    patience=$long doctor 1
    shows "warning  clock: that of "
    shows "is 3600.0 s behind ours"
    stop_daemon
fi

say "no place for one more process"
mkfifo "$work/hold"
"$peers/take_ports" $((7410 + 250 * domain)) 238 <"$work/hold" >"$work/taken" 2>&1 9>&- &
others=$!
exec 7>"$work/hold"
wait_for 20 grep -q bound "$work/taken" || fail "ports: $(cat "$work/taken")"
doctor 3
shows "warning  indices: 103 of the 103 participant indices of clients are taken in the domain, one by each process; to do: end processes"
shows "problem  DDS: domain $domain cannot be joined: other processes of this machine have participant indices 16 to 118"
doctor 3 "$apart"
shows "cannot be used: Failed to find a free participant index for domain $domain; to do: other processes have participant indices"
exec 7>&-
wait "$others"
others=

say "usage"
expect 2 "$bin/percuss" doctor --local
expect 2 "$bin/percuss" doctor --domain many
