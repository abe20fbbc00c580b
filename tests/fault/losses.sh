#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Clients ask while packets are lost in both directions and the daemon is killed again and again. Every
# request is answered once, the same question with the same bits, and every impact on a specimen is counted
# once. PERCUSS_BUILD: the build folder.
#
# usage: losses.sh [REQUESTS of all clients (1000000)] [CLIENTS (16)] [KILLS (100)] [LOSS per thousand (100)]
#                  [SECONDS between two kills (3)]
. "$(dirname "$0")/../service/support/lib.sh"
requests=${1:-1000000}
clients=${2:-16}
kills=${3:-100}
loss=${4:-100}
pause=${5:-3}
specimens=8
crowd=$build/tests/fault/crowd/crowd

# Cyclone DDS drops that share of what each process sends
sed "s|</Domain>|<Internal><Test><XmitLossiness>$loss</XmitLossiness></Test></Internal></Domain>|" \
    "$source_dir/config/cyclonedds.xml" >"$work/losses.xml"
export CYCLONEDDS_URI="file://$work/losses.xml"

settings "store: specimens.db"
start_daemon
began=$(date +%s)
"$crowd" "$domain" steady $((requests / clients)) --clients "$clients" --outstanding 64 \
    --specimens "$specimens" >"$work/steady" 2>"$err" 9>&- &
others=$!
killed=0
while [ "$killed" -lt "$kills" ]; do
    sleep "$pause"
    ! is_gone "$others" || break
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
    killed=$((killed + 1))
    start_daemon
done
wait "$others" || fail "clients: $(cat "$work/steady") $(tail -n 3 "$err")"
others=
took=$(($(date +%s) - began))
cat "$work/steady"
[ "$killed" -eq "$kills" ] || fail "all is answered after $killed kills: more requests are needed"

# what the store has counted against what the clients were told
unset CYCLONEDDS_URI
stop_daemon
start_daemon
strikes=$(sed -n 's/.* \([0-9]*\) strikes.*/\1/p' "$work/steady")
expect 0 percuss dents --json
counted=$(sed -n 's/.*"impacts": *\([0-9]*\).*/\1/p' "$out" | awk '{ sum += $1 } END { print sum + 0 }')
echo "$killed times killed in $took s; $counted impacts in the store, $strikes answered"
[ "$counted" = "$strikes" ] || fail "the store has counted other impacts than were answered"
stop_daemon
