#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# CYCLONEDDS_URI and the shipped config/cyclonedds.xml go together with the built-in one.
. "$(dirname "$0")/../support/lib.sh"

say "a configured daemon serves clients with the built-in configuration"
CYCLONEDDS_URI=file://$source_dir/config/cyclonedds.xml
export CYCLONEDDS_URI
start_daemon
unset CYCLONEDDS_URI
expect 0 query

say "and clients with the same configuration"
CYCLONEDDS_URI=file://$source_dir/config/cyclonedds.xml
export CYCLONEDDS_URI
expect 0 query
stop_daemon

say "shared memory without its daemon is refused, in words and at once"
if [ ! -e /tmp/roudi ]; then
    cat >"$work/shared.xml" <<'XML'
<CycloneDDS><Domain Id="any">
<!-- <SharedMemory><Enable>false</Enable></SharedMemory> -->
<SharedMemory>
  <Enable> true </Enable>
</SharedMemory>
</Domain></CycloneDDS>
XML
    for CYCLONEDDS_URI in "file://$work/shared.xml" \
        "file://$source_dir/config/cyclonedds.xml,<Domain><SharedMemory><Enable>true</></></>"; do
        export CYCLONEDDS_URI
        # it used to wait for a minute, and to end by SIGABRT
        expect 3 timeout -s KILL 30 "$bin/percuss" ping --domain "$domain" --timeout 3
        says "CYCLONEDDS_URI has SharedMemory enabled, and its daemon is not there: start iox-roudi"
        expect 1 timeout -s KILL 30 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain"
        says "iox-roudi"
    done
    unset CYCLONEDDS_URI
fi
