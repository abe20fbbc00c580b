#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A daemon runs and is not heard, as CYCLONEDDS_URI is set in one of two shells: the message names the variable,
# its effect and both configurations. And where there is no place for one more process, it says so.
. "$(dirname "$0")/../support/lib.sh"

# a configuration whose processes hear each other and nobody else
cat >"$work/apart.xml" <<EOF
<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces><AllowMulticast>false</AllowMulticast></General>
<Discovery><Tag>apart</Tag><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>
EOF
sed 's/apart/further/' "$work/apart.xml" >"$work/further.xml"
apart=file://$work/apart.xml
further=file://$work/further.xml

# asks_with URI: in a shell where it is set so; empty: not set
asks_with() {
    expect 3 env ${1:+"CYCLONEDDS_URI=$1"} "$bin/percuss" ping --domain "$domain" --timeout 0.5
}
names_uri() {
    says "percussd (process $daemon) is there $1"
    says "it must be the same for both"
    says "percuss doctor looks for the reason"
}

say "without a daemon it says what the variable decides"
asks_with ""
says "no percussd in DDS domain $domain; CYCLONEDDS_URI is not set: other machines are not heard"
asks_with "$apart"
says "no percussd in DDS domain $domain; CYCLONEDDS_URI=$apart says who is heard here"

say "set in the daemon's shell alone"
CYCLONEDDS_URI=$apart
export CYCLONEDDS_URI
start_daemon
unset CYCLONEDDS_URI
logged "info    CYCLONEDDS_URI is $apart" || fail "the log does not name it"
asks_with ""
names_uri "with CYCLONEDDS_URI=$apart, which is not set here, where 127.0.0.1 alone is heard"
CYCLONEDDS_URI=$apart "$bin/percuss" ping --domain "$domain" >"$out" 2>"$err" || fail "it does not answer those who have it"

say "set otherwise in each"
asks_with "$further"
names_uri "with CYCLONEDDS_URI=$apart, while here it is $further"

say "programs in C are told the same"
expect 1 "$build/client/examples/query" "$domain"
names_uri_in_c() {
    says "with CYCLONEDDS_URI=$apart, which is not set here"
}
names_uri_in_c

if [ "$(id -u)" = 0 ]; then
    say "another user, who may not read it, is told who may"
    # what is built may lie where nobody else may look
    cp -L "$bin/percuss" "$(ldd "$bin/percuss" | sed -n 's/.*=> \(.*libpercuss\.so[^ ]*\).*/\1/p')" "$work"
    chmod 755 "$work"
    expect 3 setpriv --reuid=65534 --regid=65534 --clear-groups env LD_LIBRARY_PATH="$work" "$work/percuss" ping \
        --domain "$domain" --timeout 0.5
    says "is there as user 0, whose CYCLONEDDS_URI only that user and root can read; here it is not set"
fi

say "in another partition it is that which is said"
stop_daemon
start_daemon --partition gears
asks_with ""
says "no percussd in DDS domain $domain; one is in partition gears"
stop_daemon

say "set in the client's shell alone"
start_daemon
logged "info    CYCLONEDDS_URI is not set: this machine alone is heard" || fail "the log does not say so"
asks_with "$apart"
names_uri "without CYCLONEDDS_URI and hears 127.0.0.1 alone, while here it is $apart"

say "one that is stopped"
kill -STOP "$daemon"
asks_with ""
says "percussd (process $daemon) is there and stopped: kill -CONT $daemon"
kill -CONT "$daemon"
stop_daemon

# takes INDICES: participant indices of the domain, from 0 on
takes() {
    mkfifo "$work/hold"
    "$peers/take_ports" $((7410 + 250 * domain)) $((2 * $1)) <"$work/hold" >"$work/taken" 2>&1 9>&- &
    others=$!
    exec 7>"$work/hold"
    rm "$work/hold"
    wait_for 20 grep -q bound "$work/taken" || fail "ports: $(cat "$work/taken")"
}
gives_back() {
    exec 7>&-
    wait "$others"
    others=
}

say "where other processes have all participant indices, it names them and the setting"
takes 119
asks_with ""
says "other processes of this machine have participant indices 16 to 118 of domain $domain (UDP ports"
says "CYCLONEDDS_URI (config/cyclonedds.xml is a beginning) with a higher Discovery/MaxAutoParticipantIndex than 119"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "a higher Discovery/MaxAutoParticipantIndex than 119"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "percussd: domain: $domain: other processes of this machine have participant indices 0 to 118"
gives_back

say "and where there is one left it has it"
takes 118
# clients of other stories that look around may have it for a moment
has_place() {
    asks_with ""
    grep -q "no percussd in DDS domain $domain" "$err"
}
wait_for 10 has_place || fail "there is none"
gives_back

say "a configuration has 9 of them, unless it says more"
sed 's/<MaxAuto.*Index>//' "$work/apart.xml" >"$work/few.xml"
takes 9
asks_with "file://$work/few.xml"
says "Failed to find a free participant index for domain $domain"
says "Discovery/MaxAutoParticipantIndex, 9 unless it is set, has to be higher for all of them"
asks_with "$apart"
says "no percussd in DDS domain $domain"
gives_back

say "a configuration that cannot be used is named"
asks_with "file://$work/none.xml"
says "Cyclone DDS cannot use CYCLONEDDS_URI=file://$work/none.xml"

say "and so is a machine without 127.0.0.1, where there may be one"
if unshare -rn true 2>/dev/null; then
    expect 3 unshare -rn "$bin/percuss" ping --domain "$domain" --timeout 0.5
    says "127.0.0.1 is not up"
fi
