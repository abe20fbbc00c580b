#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# A program that answers in its own process links no DDS: fails on an archive that asks for a symbol of Cyclone
# DDS's, or of what only idl/'s generated source has. The last one does, and must be found out.
# usage: no_dds.sh ARCHIVE... ARCHIVE_WITH_DDS
set -u
[ $# -ge 2 ] || exit 2

# what an archive wants of DDS, one symbol a line; fails if it cannot be read
wanted() {
    symbols=$(nm -A -u "$1") || return 2
    echo "$symbols" | grep -E ' U (dds|ddsi|ddsrt)_| U percuss_v1_[A-Za-z]+_(desc|ops)$'
}

bad=0
while [ $# -gt 1 ]; do
    if wanted "$1" || [ $? -ne 1 ]; then
        echo "no_dds: $1 needs DDS, or cannot be read" >&2
        bad=1
    fi
    shift
done
if ! wanted "$1" >/dev/null; then
    echo "no_dds: nothing of DDS seen in $1, which uses it" >&2
    bad=1
fi
exit $bad
