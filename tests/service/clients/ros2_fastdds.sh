#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A program on Fast DDS, from the IDL by its own generator, asks percuss-ros2 and reads what it announces.
command -v fastddsgen >/dev/null && command -v g++ >/dev/null &&
    [ -e /usr/include/fastdds/dds/domain/DomainParticipant.hpp ] || {
    echo "skipped: no Fast DDS (Debian: libfastrtps-dev, fastddsgen, g++)" >&2
    exit 77
}
. "$(dirname "$0")/../support/lib.sh"

# the program, made anew where anything of it has changed
made=$build/ros2-fastdds
idl=$build/client/ros2/percuss_msgs.idl
wanted=$(cat "$idl" "$support/ros2_fastdds.cpp" | cksum)
if [ "$(cat "$made/wanted" 2>/dev/null)" != "$wanted" ]; then
    rm -rf "$made"
    mkdir -p "$made"
    cp "$idl" "$support/ros2_fastdds.cpp" "$made"
    (cd "$made" && fastddsgen percuss_msgs.idl && for source in *.cxx ros2_fastdds.cpp; do
        g++ -std=c++17 -O0 -w -c "$source" -o "${source%.*}.o" || exit 1
    done && g++ ./*.o -lfastrtps -lfastcdr -o fast) >"$out" 2>&1 || fail "the program cannot be made"
    echo "$wanted" >"$made/wanted"
fi

start_daemon
"$bin/percuss-ros2" --domain "$domain" --ros-domain "$domain" 2>"$work/bridge.log" 9>&- &
others=$!

# this machine only, as ROS_LOCALHOST_ONLY makes it
cat >"$work/loopback.xml" <<'XML'
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors><transport_descriptor>
    <transport_id>loopback</transport_id><type>UDPv4</type>
    <interfaceWhiteList><address>127.0.0.1</address></interfaceWhiteList>
  </transport_descriptor></transport_descriptors>
  <participant profile_name="loopback" is_default_profile="true"><rtps>
    <userTransports><transport_id>loopback</transport_id></userTransports>
    <useBuiltinTransports>false</useBuiltinTransports>
  </rtps></participant>
</profiles>
XML

say "what a Fast DDS program on this machine is answered is what the command line is"
expect 0 env FASTRTPS_DEFAULT_PROFILES_FILE="$work/loopback.xml" timeout 60 "$made/fast" "$domain" 0.2
bodies=$(sed 's/ .*//' "$out" | head -n 1)
cp "$out" "$work/fast"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.2, 0, 0]}, {"id": "al-rod-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}]}
JSON
expect 0 percuss bodies --json
[ "$(grep -c '"id": ' "$out")" = "$bodies" ] || fail "$bodies bodies were announced: $(cat "$out")"
expect 0 percuss query --request "$work/request.json" --json
awk -v e="$(field restitution)" '$1 == "0:" { found = 1; d = $2 - e; exit !(d * d <= 1e-24 && e > 0) }
    END { if (!found) exit 1 }' "$work/fast" || fail "not the same: $(cat "$work/fast")"

say "in a domain of its own, with --network: heard by default settings of Fast DDS"
kill -TERM "$others"
wait "$others" || fail "the bridge ended with $?"
ros_domain=$((domain + 100))
"$bin/percuss-ros2" --domain "$domain" --ros-domain "$ros_domain" --network 2>"$work/bridge.log" 9>&- &
others=$!
expect 0 timeout 60 "$made/fast" "$ros_domain" 0.2
cmp "$out" "$work/fast" || fail "another answer: $(cat "$out")"
kill -TERM "$others"
wait "$others" || fail "the bridge ended with $?"
others=
stop_daemon
