#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Clients ask while packets are lost and overtaken in both directions and the daemon is killed again and again.
# Every request is answered once, the same question with the same bits. Then the same requests are asked of a
# daemon that nothing happens to: each specimen has as many impacts, its dents are the same to the last bit, and
# so is each answer to a strike. PERCUSS_BUILD: the build folder.
#
# usage: losses.sh [REQUESTS of all clients (1000000)] [CLIENTS (16)] [KILLS (100)] [LOST per thousand (100)]
#                  [HELD BACK per thousand (250)]
. "$(dirname "$0")/../service/support/lib.sh"
requests=${1:-1000000}
clients=${2:-16}
kills=${3:-100}
loss=${4:-100}
reorder=${5:-250}
specimens=8
crowd=$build/tests/fault/crowd/crowd
requests=$((requests / clients * clients))

# Cyclone DDS drops that share of what each process sends
sed "s|</Domain>|<Internal><Test><XmitLossiness>$loss</XmitLossiness></Test></Internal></Domain>|" \
    "$source_dir/config/cyclonedds.xml" >"$work/losses.xml"

# badly COMMAND...: its packets get lost and overtaken (fault/reorder.c)
counts=$work/packets
head -c 24 /dev/zero >"$counts"
if is_sanitized thread; then
    echo "  no packet is overtaken: the thread sanitizer bears nothing in front of it"
    reorder=0
    badly() {
        exec env CYCLONEDDS_URI="file://$work/losses.xml" "$@"
    }
else
    reorderer=$(preload "$build/tests/libreorder.so")
    badly() {
        exec env CYCLONEDDS_URI="file://$work/losses.xml" LD_PRELOAD="$reorderer" PERCUSS_REORDER="$reorder" \
            PERCUSS_REORDER_COUNT="$counts" "$@"
    }
fi

start_badly() {
    : >"$log"
    badly "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" 2>>"$log" 9>&- &
    daemon=$!
    wait_for 60 is_up_or_dead || fail "the daemon is not ready after 60 s"
    logged 'ready: domain' || fail "the daemon did not start"
}

# ask NAME [COMMAND]: the crowd, in the background; what it was answered goes into $work/NAME.told
ask() {
    ${2:-} "$crowd" "$domain" steady $((requests / clients)) --clients "$clients" --outstanding 64 \
        --specimens "$specimens" --record "$work/$1.told" >"$work/$1" 2>"$err" 9>&- &
    others=$!
}

# answered NAME: how many by now
answered() {
    count=$(tail -n 1 "$work/$1" | sed -n 's/^\([0-9]*\) of [0-9]*$/\1/p')
    echo "${count:-0}"
}

# finish NAME: waits for the crowd; what the store holds goes into $work/NAME.dents
finish() {
    wait "$others" || fail "clients: $(tail -n 1 "$work/$1") $(tail -n 3 "$err")"
    others=
    tail -n 1 "$work/$1"
    stop_daemon
    start_daemon
    expect 0 percuss dents --json
    cp "$out" "$work/$1.dents"
    stop_daemon
}

settings "store: badly.db"
start_badly
began=$(date +%s)
ask badly badly
killed=0
# the kills are spread evenly over the requests
is_far_enough() {
    [ "$(answered badly)" -ge $((requests * (killed + 1) / (kills + 1))) ] || is_gone "$others"
}
while [ "$killed" -lt "$kills" ]; do
    wait_for 600 is_far_enough || fail "$(answered badly) of $requests are answered, and no more"
    ! is_gone "$others" || break
    kill -KILL "$daemon"
    wait "$daemon" 2>/dev/null || true
    killed=$((killed + 1))
    [ $((killed * 10 % kills)) -ge 10 ] ||
        echo "  $(($(date +%s) - began)) s: $(answered badly) of $requests answered, killed $killed times"
    start_badly
done
finish badly
took=$(($(date +%s) - began))
[ "$killed" -eq "$kills" ] || fail "all is answered after $killed kills"
set -- $(od -An -v -tu8 "$counts")
echo "  $killed times killed in $took s; of $1 packets that were not lost $2 were held back, $3 overtaken"
[ "$reorder" -eq 0 ] || [ "$3" -gt 0 ] || fail "no packet was overtaken"

settings "store: quietly.db"
start_daemon
began=$(date +%s)
ask quietly
finish quietly
echo "  the same requests without any of it: $(($(date +%s) - began)) s"

strikes=$(sed -n 's/.* \([0-9]*\) strikes.*/\1/p' "$work/badly")
counted=$(sed -n 's/.*"impacts": *\([0-9]*\).*/\1/p' "$work/badly.dents" | awk '{ sum += $1 } END { print sum + 0 }')
echo "  $counted impacts on $(grep -c '"specimen"' "$work/badly.dents") specimens in the store, $strikes answered"
[ "$counted" = "$strikes" ] || fail "the store has counted other impacts than were answered"
cmp "$work/badly.dents" "$work/quietly.dents" || fail "other dents: $(diff "$work/badly.dents" "$work/quietly.dents" | head -n 8)"
for name in badly quietly; do
    sort "$work/$name.told" >"$work/$name.sorted"
done
cmp "$work/badly.sorted" "$work/quietly.sorted" ||
    fail "other answers: $(diff "$work/badly.sorted" "$work/quietly.sorted" | head -n 8)"
echo "  dents and $(wc -l <"$work/badly.sorted") answers are those of the run without, to the last bit"
