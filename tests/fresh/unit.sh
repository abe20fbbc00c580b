#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The unit under systemd: started, asked, reloaded, killed, upgraded, removed. Run by boot.sh's systemd, which ends
# with it; /unit.said says what came of it.
set -u
exec >/unit.said 2>&1

fail() {
    echo "FAILED: $*"
    systemctl status --no-pager percussd
    journalctl --no-pager -t percussd | tail -n 20
    systemctl exit 1
    exit 1
}

show() {
    systemctl show --value -p "$1" percussd
}

# becomes SECONDS PROPERTY PATTERN
becomes() {
    left=$(($1 * 10))
    until show "$2" | grep -q "$3"; do
        left=$((left - 1))
        [ "$left" -gt 0 ] || fail "$2 is $(show "$2")"
        sleep 0.1
    done
}

ask() {
    percuss query --a steel-sphere --b al-beam --speed 0.2 --specimen-b rig | grep -q '^  restitution  0\.739368 ' ||
        fail "no answer"
}

becomes 30 ActiveState '^active$'
becomes 5 StatusText '^ready: [0-9]* bodies of catalogue .*; 0 answered'
ask
becomes 5 StatusText '; 1 answered'
echo "- ready, and asked"

process=$(show MainPID)
grep -q '^CapEff:.0*$' "/proc/$process/status" || fail "it has capabilities"
grep -q '^NoNewPrivs:.1$' "/proc/$process/status" || fail "it may gain privileges"
grep -q '^Seccomp:.2$' "/proc/$process/status" || fail "it may call what it likes"
[ "$(stat -c %u "/proc/$process")" -ge 61184 ] || fail "it has a user that others have"
[ "$(stat -c %u /var/lib/private/percussd/specimens.db)" = "$(stat -c %u "/proc/$process")" ] || fail "another's store"
echo "- its own user, without capabilities"

echo '  small: {shape: sphere, material: steel, radius: 0.010}' >/tmp/small
sed -i '/^bodies:/r /tmp/small' /etc/percuss/catalogue.yaml
systemctl reload percussd || fail "reload"
percuss bodies | grep -q '^small ' || sleep 2
percuss bodies | grep -q '^small ' || fail "the catalogue was not read again"
[ "$(show MainPID)" = "$process" ] || fail "it is another process"
echo "- reloaded"

kill -KILL "$process"
becomes 15 NRestarts '^1$'
becomes 15 ActiveState '^active$'
percuss dents | grep -q '^rig .* 1 impacts' || fail "the dents are gone"
echo "- killed, and there again with its dents"

dpkg -i --force-confold /packages/percuss-daemon_*.deb >/dev/null 2>&1 || fail "dpkg -i"
[ "$(show MainPID)" != "$process" ] || fail "the old program goes on"
becomes 15 ActiveState '^active$'
ask
dpkg -r percuss-daemon >/dev/null 2>&1 || fail "dpkg -r"
becomes 15 ActiveState '^inactive$'
echo "- upgraded, and removed"
echo passed
systemctl exit 0
