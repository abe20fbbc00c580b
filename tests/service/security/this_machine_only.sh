#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Without a configuration of one's own, a daemon and its clients hear this machine only: what is answered
# when it comes from loopback is not when it comes from another network, here a namespace of its own.
. "$(dirname "$0")/../support/lib.sh"

space=percuss-$domain
near=percuss$domain
far=percusf$domain
net=10.199.$domain
remove_space() {
    ip netns del "$space" 2>/dev/null || true
    ip link del "$near" 2>/dev/null || true
}
remove_space
if ! { ip netns add "$space" && ip link add "$near" type veth peer name "$far" netns "$space"; } 2>"$err"; then
    remove_space
    say "no second network namespace (it takes root and Debian's iproute2): skipped"
    exit 77
fi
trap 'remove_space; cleanup' EXIT
ip addr add "$net.1/24" dev "$near"
ip link set "$near" up
ip -n "$space" addr add "$net.2/24" dev "$far"
ip -n "$space" link set "$far" up

# answered PORT PREFIX...: whether a participant that is announced to that port by a command under PREFIX
# is answered; the answer always goes to loopback, where we wait for it
answered() {
    port=$1
    shift
    rm -f "$work/where"
    python3 "$support/announce.py" wait 0 "$work/where" 9>&- &
    listener=$!
    others="${others:-} $listener"
    wait_for 10 test -s "$work/where" || fail "no listener"
    "$@" "$port" "$(cat "$work/where")" || fail "nothing can be sent: $*"
    code=0
    wait "$listener" || code=$?
    return "$code"
}

from_here() {
    python3 "$support/announce.py" send 127.0.0.1 "$@"
}

from_there() {
    ip netns exec "$space" python3 "$support/announce.py" send "$net.1" "$@"
}

from_our_other_address() {
    python3 "$support/announce.py" send "$net.1" "$@"
}

# a port that takes everything: packets do arrive from there
arrives() {
    python3 -c 'import socket, sys
udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
udp.bind(("0.0.0.0", 0))
udp.settimeout(10)
open(sys.argv[1], "w").write("%d\n" % udp.getsockname()[1])
udp.recv(65536)' "$work/open" 9>&- &
    listener=$!
    others="${others:-} $listener"
    wait_for 10 test -s "$work/open" || fail "no listener"
    from_there "$(cat "$work/open")" 1
    wait "$listener"
}

# sockets of the first process of a domain, RTPS 9.6.1.1
ports="$((7400 + 250 * domain + 10)) $((7400 + 250 * domain + 11))"

say "packets from the namespace arrive here"
arrives || fail "the namespace does not reach us"

say "the daemon"
start_daemon
for port in $ports; do
    answered "$port" from_here || fail "port $port: not answered on loopback"
    answered "$port" from_there && fail "port $port: answered from another network"
    answered "$port" from_our_other_address && fail "port $port: answered from an address of a network"
done
expect 0 query
stop_daemon

say "a client that waits for a server"
"$bin/percuss" ping --domain "$domain" --timeout 60 2>/dev/null 9>&- &
client=$!
others="${others:-} $client"
# clients are the processes from the 17th on
port=$((7400 + 250 * domain + 10 + 2 * 16))
wait_for 10 answered "$port" from_here || fail "port $port: the client does not answer on loopback"
answered "$port" from_there && fail "port $port: the client answers to another network"
kill "$client"

say "where the sockets cannot be closed nothing is opened"
no_proc() {
    unshare --mount sh -c 'mount -t tmpfs none /proc && exec "$@"' sh "$@"
}
expect 1 no_proc "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "its sockets cannot be closed to other machines"
# at its end the address sanitizer looks for leaks by /proc
if is_sanitized address; then code=1; else code=3; fi
expect "$code" no_proc "$bin/percuss" ping --domain "$domain"
says "its sockets cannot be closed to other machines"

say "whoever brings a configuration may be reached from elsewhere"
CYCLONEDDS_URI="<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"127.0.0.1\"/>\
</Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>\
</Discovery></Domain></CycloneDDS>"
export CYCLONEDDS_URI
start_daemon
port=${ports%% *}
answered "$port" from_there || fail "port $port: with a configuration of one's own, not answered"
stop_daemon
