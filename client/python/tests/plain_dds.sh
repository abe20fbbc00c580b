#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# The client made of the IDL alone gets the answer that percuss gets. Started by run.sh.
set -eu
python "$PERCUSS_SOURCE/client/python/examples/plain_dds.py" "$PERCUSS_DOMAIN" | tee plain
"$PERCUSS_BUILD/bin/percuss" query --a steel-sphere --b al-beam --speed 0.2 --domain "$PERCUSS_DOMAIN" --json >json
for member in restitution impulse; do
    plain=$(sed -n "s/^$member //p" plain)
    asked=$(sed -n 's/^ *"'$member'": \([^,]*\),*$/\1/p' json | head -n 1)
    # the same double, whatever its digits
    python -c "import sys; sys.exit($plain != $asked)" || { echo "$member: $plain, not $asked" >&2; exit 1; }
done
grep -q "bodies\[1\].id: 'nothing'" plain
