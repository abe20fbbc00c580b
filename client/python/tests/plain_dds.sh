#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# The client made of the IDL alone gets the answer that percuss gets, in the domain and partition that the environment
# names; and types that are made from the IDL, as docs/dds.md says, do as well. Started by run.sh.
set -eu
. "$PERCUSS_SOURCE/tests/documents.sh"
example=$PERCUSS_SOURCE/client/python/examples/plain_dds.py

fail() {
    echo "$*" >&2
    exit 1
}

# same_answer FILE: what the example printed is what percuss says
"$PERCUSS_BUILD/bin/percuss" query --a steel-sphere --b al-beam --speed 0.2 --json >json
same_answer() {
    for member in restitution impulse; do
        plain=$(sed -n "s/^$member //p" "$1")
        asked=$(sed -n 's/^ *"'$member'": \([^,]*\),*$/\1/p' json | head -n 1)
        # the same double, whatever its digits
        python -c "import sys; sys.exit($plain != $asked)" || fail "$member: $plain, not $asked"
    done
    grep -qx "domain $PERCUSS_DOMAIN" "$1" || fail "the domain is not named"
    grep -q "bodies\[1\].id: 'nothing'" "$1" || fail "no refusal"
}
python "$example" | tee plain
same_answer plain
# what the page shows, but for the domain and the last digits, which a compiler may change
cut_digits() {
    sed -e 1d -e 's/\(\.[0-9]\{9\}\)[0-9]*/\1/'
}
awk '/^domain 0$/ { inside = 1 } /^```$/ { inside = 0 } inside' "$PERCUSS_SOURCE/docs/dds.md" | cut_digits >shown
cut_digits <plain | diff - shown || fail "the page shows another answer"
# the argument counts before the environment
PERCUSS_DOMAIN=231 python "$example" "$PERCUSS_DOMAIN" >plain
same_answer plain
! PERCUSS_DOMAIN=231 python "$example" 2>err || fail "domain 231 is taken"
grep -q "domain: '231': 0..230 is allowed" err || fail "$(cat err)"

# nobody is in that partition; then somebody is
! PERCUSS_PARTITION=gears python "$example" 2>err || fail "somebody answers in no partition"
grep -q "no percussd answers in DDS domain $PERCUSS_DOMAIN, partition gears within 5 s" err || fail "$(cat err)"
printf 'catalogue: %s\n' "$PERCUSS_SOURCE/config/catalogue.yaml" >gears.yaml
"$PERCUSS_BUILD/bin/percussd" --config gears.yaml --partition gears 2>gears.log &
gears=$!
trap 'kill $gears; wait' EXIT
PERCUSS_PARTITION=gears python "$example" >plain || {
    cat gears.log >&2
    fail "not in partition gears"
}
same_answer plain

# types made by the page's commands, where there is a CPython 3.10, and an index to get the generator from
for folder in $(echo "$PATH" | tr : ' ') "${PYENV_ROOT:-$HOME/.pyenv}"/versions/3.10.*/bin; do
    "$folder/python3.10" -c 'import venv, ensurepip' 2>/dev/null || continue
    ln -s "$PERCUSS_SOURCE/idl" idl
    commands "$PERCUSS_SOURCE/docs/dds.md" cyclonedds==0.10.5 >make-types
    [ -s make-types ] || fail "the page has no such commands"
    PATH=$folder:$PATH sh -eu make-types >log 2>&1 || {
        grep -qi "no matching distribution\|connection\|resolve" log && break
        cat log >&2
        exit 1
    }
    grep -q "types.byte" percuss/v1/_percuss_wire.py || fail "no octets among the types"
    cat >made.py <<END
import sys

# before the package of this environment: percuss/v1 of this folder
sys.path[:0] = [".", "$(dirname "$example")"]
import plain_dds
from percuss.v1 import BodyMotion, Contact, Options, Reply, Request

made = {kind.__name__: list(kind.__annotations__) for kind in (BodyMotion, Contact, Options, Reply, Request)}
for name, members in made.items():
    ours = list(getattr(plain_dds, name).__annotations__)
    assert ours == members[: len(ours)], (name, ours, members)
plain_dds.Reply = Reply
plain_dds.main()
END
    python made.py >plain
    same_answer plain
    echo "types made from the IDL: the same answer"
    break
done
