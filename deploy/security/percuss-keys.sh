#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Keys and permissions of a secured percuss (docs/security.md): an authority, and an identity for the
# daemon, each client and each onlooker. What no permission allows is denied.
# usage: percuss-keys.sh create DIR             the authority, in DIR/authority, to be kept off the network
#        percuss-keys.sh add DIR NAME ROLE      the identity DIR/NAME, to be taken where it is used
#        percuss-keys.sh revoke DIR NAME        no longer: DIR/authority/crl.pem, for the folder of each daemon
#        percuss-keys.sh revoke DIR FILE.pem    the same with one certificate
# ROLE: serves (percussd), asks, administers (asks, and clears specimens), observes (sees who serves what)
# PERCUSS_KEY_DAYS: how long what is made holds, from now (default 825)
set -eu
umask 077

usage() {
    sed -n 's/^# \{0,1\}//; /^usage:/,/^PERCUSS_KEY_DAYS/p' "$0" >&2
    exit 2
}

fail() {
    echo "percuss-keys: $*" >&2
    exit 1
}

days=${PERCUSS_KEY_DAYS:-825}
case $days in
'' | *[!0-9]* | 0*) fail "PERCUSS_KEY_DAYS: '$days' is not a whole number of days" ;;
esac
command -v openssl >/dev/null || fail "openssl is needed (apt-get install openssl)"

new_key() {
    openssl genpkey -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -out "$1"
}

# certificate_authority NAME TITLE
certificate_authority() {
    new_key "$authority/$1.key"
    openssl req -x509 -new -key "$authority/$1.key" -days "$days" -subj "/O=percuss/CN=$2" \
        -out "$authority/$1.pem"
}

# sign FILE.xml FILE.p7s
sign() {
    openssl smime -sign -text -in "$1" -out "$2" -signer "$authority/permissions_ca.pem" \
        -inkey "$authority/permissions_ca.key" 2>/dev/null || fail "$1: cannot be signed"
}

# whoever is not known is not let in; everything is signed and, but for who is there, encrypted
governance() {
    cat <<END
<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>SIGN</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>SIGN</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
END
}

create() {
    [ ! -e "$authority" ] || fail "$authority: is there already"
    mkdir -p "$authority/issued"
    : >"$authority/issued/all"
    certificate_authority identity_ca "percuss identities"
    certificate_authority permissions_ca "percuss permissions"
    governance >"$authority/governance.xml"
    sign "$authority/governance.xml" "$authority/governance.p7s"
}

# allow VERB PARTITION TOPIC...
allow() {
    echo "        <$1><topics>"
    partition=$2
    verb=$1
    shift 2
    for topic in "$@"; do
        echo "          <topic>percuss/v1/$topic</topic>"
    done
    echo "        </topics>${partition:+<partitions><partition>$partition</partition></partitions>}</$verb>"
}

requests="Request BatchRequest EnsembleRequest"
replies="Reply BatchReply EnsembleReply EnsembleProgress EnsembleSamples Trace"
announcements="ServerStatus Body Dents"

# what a role may do, in whatever partition; a client's replies are in one of its own
rules() {
    case $1 in
    serves)
        allow publish "*" $announcements
        allow publish "c_*" $replies
        allow subscribe "*" $requests Dents ServerStatus
        ;;
    asks)
        allow publish "*" $requests
        allow subscribe "*" $announcements
        allow subscribe "c_*" $replies
        ;;
    administers)
        allow publish "*" $requests Dents
        allow subscribe "*" $announcements
        allow subscribe "c_*" $replies
        ;;
    observes)
        allow subscribe "*" $announcements
        ;;
    esac
}

# permissions NAME ROLE
permissions() {
    cat <<END
<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="$1">
      <subject_name>CN=$1,OU=$2,O=percuss</subject_name>
      <validity>
        <not_before>$(date -u -d '1 day ago' +%Y-%m-%dT%H:%M:%S)</not_before>
        <not_after>$(date -u -d "$days days" +%Y-%m-%dT%H:%M:%S)</not_after>
      </validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
$(rules "$2")
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
END
}

check_name() {
    case $1 in
    '' | authority | -* | *[!A-Za-z0-9_-]*) fail "NAME: '$1': letters, digits, _ and - are allowed" ;;
    esac
}

add() {
    check_name "$1"
    case $2 in
    serves | asks | administers | observes) ;;
    *) fail "ROLE: '$2': must be serves, asks, administers or observes" ;;
    esac
    [ -e "$authority/governance.p7s" ] || fail "$authority: is not there; percuss-keys.sh create $root makes it"
    [ ! -e "$root/$1" ] || fail "$root/$1: is there already"
    # the folder appears when it is whole
    part=$(mktemp -d "$root/.new-XXXXXX")
    trap 'rm -rf "$part"' EXIT
    new_key "$part/key.pem"
    openssl req -new -key "$part/key.pem" -subj "/O=percuss/OU=$2/CN=$1" -out "$part/request"
    openssl x509 -req -in "$part/request" -CA "$authority/identity_ca.pem" -CAkey "$authority/identity_ca.key" \
        -set_serial "0x$(openssl rand -hex 16)" -days "$days" -out "$part/cert.pem" 2>/dev/null ||
        fail "$1: no certificate could be made"
    permissions "$1" "$2" >"$part/permissions.xml"
    sign "$part/permissions.xml" "$part/permissions.p7s"
    cp "$authority/identity_ca.pem" "$authority/permissions_ca.pem" "$authority/governance.p7s" "$part"
    [ ! -e "$authority/crl.pem" ] || cp "$authority/crl.pem" "$part"
    mkdir -p "$authority/issued"
    cp "$part/cert.pem" "$authority/issued/$1.$(openssl x509 -in "$part/cert.pem" -noout -serial | cut -d= -f2).pem"
    rm "$part/request" "$part/permissions.xml"
    chmod 0600 "$part"/*
    [ ! -e "$part/crl.pem" ] || chmod 0644 "$part/crl.pem"
    mv "$part" "$root/$1"
}

# database COMMAND...: openssl ca in the authority, whose record of the revoked is revoked
database() {
    settings=$(mktemp)
    trap 'rm -f "$settings" "$settings.said"' EXIT
    printf '%s\n' '[ca]' 'default_ca = one' '[one]' 'database = revoked' 'default_md = sha256' \
        'unique_subject = no' >"$settings"
    (cd "$authority" && openssl ca -config "$settings" -cert identity_ca.pem -keyfile identity_ca.key "$@") \
        2>"$settings.said" || {
        cat "$settings.said" >&2
        return 1
    }
    rm -f "$settings" "$settings.said"
}

# revoke_certificate FILE, unless it is already
revoke_certificate() {
    serial=$(openssl x509 -in "$1" -noout -serial | cut -d= -f2)
    ! cut -f 4 "$authority/revoked" | grep -qxi "0*$serial" || return 0
    case $1 in
    /*) database -revoke "$1" ;;
    *) database -revoke "$PWD/$1" ;;
    esac || fail "$1: cannot be revoked"
}

# all certificates of that name
revoke_name() {
    check_name "$1"
    found=
    for certificate in "$authority/issued/$1".*.pem "$root/$1/cert.pem"; do
        [ -e "$certificate" ] || continue
        found=yes
        revoke_certificate "$certificate"
    done
    [ -n "$found" ] || fail "$1: no certificate of that name in $authority/issued or $root"
    [ -e "$authority/issued/all" ] ||
        echo "percuss-keys: $authority is from before percuss 0.3.0, which keeps a copy of what it issues: other" \
            "certificates of $1 stay good; revoke them by their files, or create a new authority" >&2
}

revoke_file() {
    openssl verify -no_check_time -CAfile "$authority/identity_ca.pem" "$1" >/dev/null 2>&1 ||
        fail "$1: must be a certificate (PEM) that $authority has signed"
    revoke_certificate "$1"
}

revoke() {
    [ -e "$authority/identity_ca.key" ] || fail "$authority: is not there"
    [ -e "$authority/revoked" ] || : >"$authority/revoked"
    case $1 in
    *.pem) revoke_file "$1" ;;
    *) revoke_name "$1" ;;
    esac
    database -gencrl -crldays "$days" -out crl.new || fail "no list of the revoked"
    chmod 0644 "$authority/crl.new"
    mv "$authority/crl.new" "$authority/crl.pem"
    echo "percuss-keys: copy $authority/crl.pem into the folder of each daemon and reload it: $1 is refused then"
}

[ $# -ge 2 ] || usage
root=$2
authority=$root/authority
case $1:$# in
create:2) create ;;
add:4) add "$3" "$4" ;;
revoke:3) revoke "$3" ;;
*) usage ;;
esac
