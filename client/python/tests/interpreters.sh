#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Every CPython that is found, on the PATH and of pyenv: pip installs the package into an empty environment with the
# newest numpy, the first Python that is allowed also with the oldest one, and tests that need nothing else pass, more of
# them with the oldest and the newest Python; one that is too old is refused by pip. Started by run.sh.
set -eu
package=$PERCUSS_SOURCE/client/python
export PIP_DISABLE_PIP_VERSION_CHECK=1

# oldest MINOR: the first numpy of those allowed that has wheels for Python 3.MINOR; nothing: not known
oldest() {
    case $1 in
    9 | 10) echo 1.23.0 ;;
    11) echo 1.23.2 ;;
    12) echo 1.26.0 ;;
    13) echo 2.1.0 ;;
    esac
}

. "$package/tests/pythons.sh"

# install FOLDER [NUMPY]: the package into an empty environment; an index may be away for a moment
install() {
    rm -rf venv
    "$python" -m venv venv
    for pause in 5 15 0; do
        venv/bin/pip install --only-binary numpy "$@" >log 2>&1 </dev/null && return
        sleep "$pause"
    done
    cat log >&2
    exit 1
}

cat >ask.py <<'END'
"""What a user does first; then what reads every kind of member."""
import os
import sys

import numpy as np

import percuss
from percuss import measured

catalogue = os.environ["PERCUSS_SOURCE"] + "/config/catalogue.yaml"
with percuss.Local(catalogue) as local, percuss.connect(timeout=10.0) as client:
    answers = []
    for one in (local, client):
        question = percuss.contact_pair(one.bodies()["steel-sphere"], one.bodies()["al-beam"], speed=0.2)
        reply = one.solve(question).raise_for_status()
        subs = reply.contacts[0].sub_impacts
        assert len(subs) == reply.contacts[0].sub_impact_count == 2 and subs.dtype == percuss.SUB_IMPACT, subs
        assert abs(subs["start"][1] - 5.2471e-3) < 1e-6, subs
        assert reply.model.bodies[1].theory == "timoshenko" and len(reply.velocity_after) == 2, reply
        traced = percuss.trace(question, one).contacts[0]
        assert 210.0 < traced.force.max() < 210.5, traced.force.max()
        answers.append(reply.contacts[0].restitution)
    assert answers[0] == answers[1], answers
    (curve,) = percuss.sweep("steel-sphere", "al-beam", [0.1, 0.2], local).curves
    assert curve.restitution[1] == answers[0], curve
    drawn = percuss.Ensemble(
        question, [percuss.Input("speed", percuss.Distribution.UNIFORM, 0.1, 0.4)], samples=20, list_samples=True
    )
    rows = percuss.ensemble(drawn, local).rows
    assert rows is not None and len(rows) == 20, rows
    assert local.servers() and isinstance(client.servers()[0].tasks, tuple), client.servers()
    assert client.specimens() == {}, client.specimens()
    compared = measured.compare({"speed": [0.2, 0.3], "restitution": [0.7, 0.7]}, "steel-sphere", "al-beam", local)
    assert compared.simulated.restitution[0] == answers[0], compared
print(f"CPython {sys.version.split()[0]}, numpy {np.__version__}: {answers[0]}")
END

# answered TEST...: asks, and runs these tests, which need numpy alone
answered() {
    venv/bin/python ask.py
    for test; do
        venv/bin/python "$package/tests/test_$test.py" >log 2>&1 || {
            cat log >&2
            exit 1
        }
    done
}

least=$(sed -n 's/^requires-python = ">=3\.\([0-9]*\)"$/\1/p' "$package/pyproject.toml")
count=0
found >pythons
newest=$(sed -n '$s/ .*//p' pythons)
while read -r minor python; do
    [ "$minor" -ge 8 ] || continue # no pip so old knows how an index answers today
    if [ "$minor" -lt "$least" ]; then
        rm -rf venv
        "$python" -m venv venv
        ! venv/bin/pip install --no-deps "$package" >log 2>&1 </dev/null &&
            grep -q "requires a different Python: .* not in '>=3\.$least'" log || {
            cat log >&2
            exit 1
        }
        echo "CPython 3.$minor: refused by pip, as it should be"
        continue
    fi
    old=$(oldest "$minor")
    if [ "$count" -eq 0 ] && [ "$old" ]; then
        install "$package" "numpy ==$old"
        answered traces
    fi
    # at the root of the tree it is the same
    install "$PERCUSS_SOURCE"
    case $count,$minor in
    0,* | *,"$newest") answered traces slowscale client ;;
    *) answered traces ;;
    esac
    count=$((count + 1))
done <pythons
[ "$count" -ge 1 ]
