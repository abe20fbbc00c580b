#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A secured deployment: who has an identity of the same authority may do what its role says; who has
# none, a foreign or a forged one gets nothing; and nothing starts half secured.
. "$(dirname "$0")/../support/lib.sh"
. "$(dirname "$0")/../support/keys.sh"

# as NAME COMMAND [ARGUMENT...]: a command of percuss with that identity
as() {
    identity=$1
    command=$2
    shift 2
    percuss "$command" --security "$keys/$identity" "$@"
}

ask_as() {
    identity=$1
    shift
    as "$identity" query --a steel-sphere --b al-beam --speed 0.3 "$@"
}

# strike NAME: an impact on the specimen bar-1
strike() {
    as "$1" query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar-1
}

say "an authority, and one of each role"
mkdir "$keys" "$work/foreign"
expect 0 make_keys create "$keys"
for role in serves asks administers observes; do
    expect 0 make_keys add "$keys" "the-one-that-$role" "$role"
    mv "$keys/the-one-that-$role" "$keys/$role" # a folder may be moved
done
expect 0 make_keys create "$work/foreign"
expect 0 make_keys add "$work/foreign" asks asks
[ -z "$(find "$keys" "$work/foreign" -type f -perm /077)" ] || fail "a file is open to others"
expect 1 make_keys create "$keys"
says "is there already"
expect 1 make_keys add "$keys" '../x' asks
says "letters, digits"
expect 1 make_keys add "$keys" somebody reigns
says "must be serves, asks, administers or observes"

say "a daemon does not start half secured"
settings "security: $keys/half"
for file in identity_ca.pem cert.pem key.pem permissions_ca.pem governance.p7s permissions.p7s; do
    rm -rf "$keys/half"
    cp -r "$keys/serves" "$keys/half"
    rm "$keys/half/$file"
    expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
    says "$file: No such file"
    expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
    says "$file: No such file"
done
cp "$keys/serves/permissions.p7s" "$keys/half"
cp "$work/foreign/asks/key.pem" "$keys/half"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "key.pem must be the key of cert.pem"
cp "$keys/serves/key.pem" "$keys/half"
chmod 0640 "$keys/half/key.pem"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "key.pem: must be open to its owner alone"
chmod 0600 "$keys/half/key.pem"
sed 's/<default>DENY/<default>ALLOW/' "$keys/serves/permissions.p7s" >"$keys/half/permissions.p7s"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
says "its certificate or its permissions are not good"

say "a client neither"
expect 2 as nobody ping
says "identity_ca.pem: No such file"

# certify NAME FIRST LAST: the identity anew, with a certificate from the one date to the other
certify() {
    mkdir -p "$work/ca"
    : >"$work/ca/index"
    printf '%s\n' '[ca]' 'default_ca = one' '[one]' "database = $work/ca/index" "new_certs_dir = $work/ca" \
        'rand_serial = yes' 'default_md = sha256' 'policy = any' 'unique_subject = no' '[any]' 'O = supplied' \
        'OU = supplied' 'CN = supplied' >"$work/ca/openssl.cnf"
    subject=$(openssl x509 -in "$keys/$1/cert.pem" -noout -subject -nameopt compat | sed 's/^subject=//')
    openssl req -new -key "$keys/$1/key.pem" -subj "$subject" -out "$work/ca/request"
    openssl ca -batch -notext -config "$work/ca/openssl.cnf" -in "$work/ca/request" -startdate "$2" \
        -enddate "$3" -cert "$keys/authority/identity_ca.pem" -keyfile "$keys/authority/identity_ca.key" \
        -out "$keys/$1/cert.pem" 2>"$err" || fail "no certificate"
}

say "nor whose certificate or permissions have ended, or not begun"
cp -r "$keys/serves" "$keys/late"
cp -r "$keys/asks" "$keys/late-client"
for folder in late late-client; do
    certify $folder 20200101000000Z 20240229120000Z
done
days=$((($(date +%s) - $(date -d 2024-02-29T12:00:00Z +%s)) / 86400))
settings "security: $keys/late"
for action in "--domain $domain" --check-config; do
    expect 1 "$bin/percussd" --config "$work/percussd.yaml" $action
    grep -q "security: $keys/late/cert.pem: ended [0-9]* days ago, on 2024-02-29" "$err" || fail "it is not told"
    said=$(sed -n 's/.*ended \([0-9]*\) days ago.*/\1/p' "$err")
    [ $((said - days)) -le 1 ] && [ "$said" -ge "$days" ] || fail "$said days, not $days"
done
expect 2 as late-client ping
says "security: $keys/late-client/cert.pem: ended "
certify late 22000101000000Z 22010101000000Z
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "/cert.pem: begins in "
cp "$keys/serves/cert.pem" "$keys/late"
sed 's|<not_after>.*</not_after>|<not_after>2024-02-29T12:00:00</not_after>|' \
    "$keys/serves/permissions.p7s" >"$keys/late/permissions.p7s"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "/permissions.p7s: ended "
cp "$keys/serves/permissions.p7s" "$keys/late"
echo none >"$keys/late/identity_ca.pem"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
says "/identity_ca.pem: must be a certificate"

say "what ends within 30 days is told, and serves"
PERCUSS_KEY_DAYS=20
export PERCUSS_KEY_DAYS
expect 0 make_keys add "$keys" short-lived serves
unset PERCUSS_KEY_DAYS
settings "security: $keys/short-lived" "metrics: $work/percuss.prom"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
grep -q "warning: security: $keys/short-lived/[a-z_.7]*: ends in [0-9]* days, on 20" "$err" || fail "not told"
start_daemon
logged "warning security: $keys/short-lived/.*: ends in [0-9]* days" || fail "the log does not say so"
expect 0 as asks ping
grep -q "ends in" "$err" && fail "it warns of what holds for years"
wait_for 10 test -s "$work/percuss.prom" || fail "no metrics"
left=$(($(sed -n 's/^percuss_identity_end_seconds //p' "$work/percuss.prom") - $(date +%s)))
[ $left -gt $((19 * 86400)) ] && [ $left -le $((20 * 86400)) ] || fail "$left s are left"
PERCUSS_KEY_DAYS=20
export PERCUSS_KEY_DAYS
expect 0 make_keys add "$keys" short-client asks
unset PERCUSS_KEY_DAYS
# on standard error, once for each command, and what is on standard output stays JSON
for arguments in ping "query -a steel-sphere -b al-beam --speed 0.3 --json" \
    "sweep -a steel-sphere -b al-beam --speed 0.1:0.3:3 --csv"; do
    expect 0 as short-client $arguments
    [ "$(grep -c 'percuss: warning: security: .*short-client/[a-z_.7]*: ends in [0-9]* days, on 20' "$err")" -eq 1 ] ||
        fail "not told once by $arguments"
    grep -q 'ends in' "$out" && fail "told on standard output"
done
stop_daemon

# DDS takes the participant away then; whoever makes a reader in it is ended
say "one that ends while a client is looking for a server is told then, not as a time-out"
cp -r "$keys/asks" "$keys/ending"
certify ending "$(date -u -d '-1 day' +%Y%m%d%H%M%SZ)" "$(date -u -d '+8 seconds' +%Y%m%d%H%M%SZ)"
expect 3 as ending ping --timeout 60
grep -q "warning: security: $keys/ending/cert.pem: ends in less than a day" "$err" || fail "it does not warn"
[ "$(grep -c "security: $keys/ending/cert.pem: end[a-z]* " "$err")" -eq 2 ] || fail "its end is not told"
certify ending 22000101000000Z 22010101000000Z
expect 2 as ending ping
says "security: $keys/ending/cert.pem: begins in "
expect 2 as ending status --watch
says "security: $keys/ending/cert.pem: begins in "

settings "security: $keys/serves"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
grep -q "ends in" "$err" && fail "it warns of what holds for years"

say "roles"
settings "security: $keys/serves" "store: $work/store.db"
start_daemon
logged "DDS Security: the identity in" || fail "the log does not say that it is secured"
expect 0 ask_as asks
grep -v "^  server" "$out" >"$work/secured"
expect 0 as asks bodies
expect 0 strike asks
expect 0 as observes dents
shows "bar-1"
expect 3 as observes dents --specimen bar-1 --clear
says "our permissions do not allow it"
expect 3 as asks dents --specimen bar-1 --clear
says "our permissions do not allow it"
expect 0 as asks dents --specimen bar-1
expect 0 strike administers
expect 0 as administers dents --specimen bar-1 --clear
expect 5 as asks dents --specimen bar-1
expect 0 as observes status
expect 0 as observes bodies
shows "al-beam"
cp "$out" "$work/bodies"
expect 0 as asks bodies
cmp "$out" "$work/bodies" || fail "who observes sees other bodies"
expect 3 as observes bodies --server 0123456789
says "with an id that begins with 0123456789"
expect 1 env PERCUSS_SECURITY="$keys/observes" "$bin/percuss-ros2" --domain "$domain" --ros-domain "$domain"
says "do not allow asking"
expect 3 ask_as observes
says "our permissions do not allow it"
expect 3 as observes ping
says "our permissions do not allow it"
expect 3 ask_as serves

say "by the environment"
PERCUSS_SECURITY=$keys/asks
export PERCUSS_SECURITY
expect 0 query
unset PERCUSS_SECURITY

say "without an identity, or with a foreign one, there is no server"
expect 3 query --timeout 1
says "no percussd in DDS domain $domain"
says "does not announce itself to us (a secured one does not, without --security)"
expect 3 percuss doctor --timeout 1
shows "; to do: name the folder of an identity: --security DIR, or PERCUSS_SECURITY"
expect 0 ask_as asks
expect 0 percuss doctor --security "$keys/asks"
shows "ok       daemon: percussd "
expect 3 percuss doctor --security "$keys/none" --timeout 1
shows "problem  identity: security: $keys/none/identity_ca.pem: No such file or directory"
cp -r "$work/foreign/asks" "$keys/foreign"
expect 3 ask_as foreign
says "no percussd in DDS domain $domain accepts our certificate and permissions"
wait_for 10 logged "Certificate not valid" || fail "the daemon does not log the stranger"
expect 3 percuss status --timeout 1

say "nor with permissions that somebody else has signed"
cp -r "$keys/observes" "$keys/forged"
openssl smime -verify -noverify -text -in "$keys/asks/permissions.p7s" 2>/dev/null |
    tr -d '\r' | sed 's/asks/observes/g' >"$work/permissions.xml"
grep -q "CN=the-one-that-observes,OU=observes" "$work/permissions.xml" || fail "no forgery"
authority=$work/foreign/authority
openssl smime -sign -text -in "$work/permissions.xml" -out "$keys/forged/permissions.p7s" \
    -signer "$authority/permissions_ca.pem" -inkey "$authority/permissions_ca.key"
cp "$authority/permissions_ca.pem" "$authority/governance.p7s" "$keys/forged"
expect 3 ask_as forged
says "no percussd in DDS domain $domain accepts our certificate and permissions"
expect 0 ask_as asks
stop_daemon

say "in a partition: the same"
settings "security: $keys/serves" "partition: gears"
start_daemon
expect 0 ask_as asks --partition gears
grep -v "^  server" "$out" | cmp - "$work/secured" || fail "another answer"
expect 0 as observes status --partition gears
expect 3 ask_as asks --timeout 1
expect 3 query --timeout 1 --partition gears
stop_daemon

say "who is secured asks nobody who is not, and the answers are the same"
settings
start_daemon
logged "DDS Security" && fail "the log says that it is secured"
expect 3 ask_as asks --timeout 1
expect 0 query
grep -v "^  server" "$out" | cmp - "$work/secured" || fail "another answer"
stop_daemon

say "a daemon that others may reach says so"
CYCLONEDDS_URI=file://$source_dir/config/cyclonedds.xml
export CYCLONEDDS_URI
start_daemon
logged "warning CYCLONEDDS_URI is set and the setting security is not" || fail "the log does not say so"
expect 0 query
stop_daemon
settings "security: $keys/serves"
start_daemon
logged "warning CYCLONEDDS_URI" && fail "the log says that anybody may ask"
expect 0 ask_as asks
expect 3 query --timeout 1
stop_daemon
