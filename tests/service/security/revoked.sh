#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A certificate is withdrawn: a reload cuts off who shows it, and from then on he is not let in, at a start neither.
. "$(dirname "$0")/../support/lib.sh"
. "$(dirname "$0")/../support/keys.sh"
ask_as() {
    identity=$1
    shift
    percuss query --security "$keys/$identity" --a steel-sphere --b al-beam --speed 0.3 "$@"
}
answered() {
    expect 0 percuss status --security "$keys/dashboard" --json
    field answered
}
reload() {
    kill -HUP "$daemon"
    wait_for 5 logged "$1" || fail "the log does not say: $1"
}

mkdir "$keys"
expect 0 make_keys create "$keys"
for identity in "daemon serves" "rig asks" "stolen asks" "dashboard observes"; do
    # shellcheck disable=SC2086
    expect 0 make_keys add "$keys" $identity
done
settings "security: $keys/daemon" "metrics: $work/percuss.prom"
start_daemon
expect 0 ask_as stolen

say "withdrawn while it asks: cut off by the reload, and others are not"
"$peers/wire_patched" "$domain" "$keys/stolen" "$peers/libpatched_plugins.so" 30 >"$work/stolen" 2>&1 9>&- &
stolen=$!
others="${others:-} $stolen"
before=$(answered)
asks_on() {
    [ "$(answered)" -gt "$before" ]
}
wait_for 10 asks_on || fail "it does not ask"
mv "$keys/stolen" "$work/away" # as the rule is: copied to its machine, and not kept
expect 0 make_keys revoke "$keys" stolen
shows "into the folder of each daemon"
[ "$(stat -c %a "$keys/authority/crl.pem")" = 644 ] || fail "a daemon of another user cannot read the list"
cp "$keys/authority/crl.pem" "$work/first.pem"
cp "$keys/authority/crl.pem" "$keys/daemon"
reload 'daemon/crl.pem: revoked certificates: 1, cut off now: [1-9]'
before=$(answered)
sleep 0.5
[ "$(answered)" -eq "$before" ] || fail "it is still answered"
kill "$stolen"
expect 0 ask_as rig

say "it is not let in again, and the log and the metrics say so"
expect 3 percuss query --security "$work/away" --a steel-sphere --b al-beam --speed 0.3 --timeout 1
says "no percussd in DDS domain $domain accepts our certificate and permissions"
wait_for 5 logged 'the certificate of /O=percuss/OU=asks/CN=stolen is revoked' || fail "the log does not tell"
counted() {
    [ "$(sed -n 's/^percuss_revoked_total //p' "$work/percuss.prom")" -ge 2 ]
}
wait_for 5 counted || fail "the metrics do not tell"

say "another one, a new certificate for the first name, and a list that is none"
rm "$keys/authority/issued/all" # as authorities of 0.2.0 are
expect 0 make_keys revoke "$keys" rig
says "other certificates of rig stay good; revoke them by their files, or create a new authority"
expect 1 make_keys revoke "$keys" "$keys/rig/permissions_ca.pem"
says "must be a certificate (PEM) that $keys/authority has signed"
expect 0 make_keys add "$keys" stolen asks
cp "$keys/authority/crl.pem" "$keys/daemon"
reload 'daemon/crl.pem: revoked certificates: 2,'
expect 3 ask_as rig --timeout 1
expect 0 ask_as stolen
expect 1 make_keys revoke "$keys" nobody
says "no certificate of that name"
echo none >"$keys/daemon/crl.pem"
reload 'daemon/crl.pem: must be a list of revoked certificates (PEM) that identity_ca.pem has signed; the last list stays'
expect 3 ask_as rig --timeout 1
rm "$keys/daemon/crl.pem"
reload 'warning security: .*daemon/crl.pem: is not there any more; the last list stays'
expect 3 ask_as rig --timeout 1
cp "$work/first.pem" "$keys/daemon/crl.pem"
reload 'warning security: .*daemon/crl.pem: lacks entries of the last list: 1, which are no longer revoked'
stop_daemon

say "at a start as well; nor does anybody start with a certificate that is revoked"
echo none >"$keys/daemon/crl.pem"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "daemon/crl.pem: must be a list of revoked certificates"
cp "$keys/authority/crl.pem" "$keys/daemon"
start_daemon
expect 3 ask_as rig --timeout 1
expect 0 ask_as stolen
stop_daemon
cp "$keys/authority/crl.pem" "$keys/rig"
expect 2 ask_as rig
says "rig/cert.pem: is revoked, by crl.pem"

say "the daemon's own key: a client of a process that had let it in refuses it, and so do its others"
expect 0 make_keys add "$keys" other asks
[ "$(stat -c %a "$keys/other/crl.pem" "$keys/other/key.pem" | xargs)" = "644 600" ] || fail "modes of a new folder"
rm "$keys/other/crl.pem"
start_daemon
clients_begin
act '0: ok' "open 0 $keys/stolen 30"
expect 0 make_keys revoke "$keys" "$keys/daemon/cert.pem"
cp "$keys/authority/crl.pem" "$keys/stolen"
act '1: no server' "open 1 $keys/stolen 1"
act '2: no server' "open 2 $keys/other 1"
clients_end
expect 0 percuss query --security "$keys/other" --a steel-sphere --b al-beam --speed 0.3
