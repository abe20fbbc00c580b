#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# A wheel with the libraries inside, in an empty environment: it asks in process, with the shipped catalogue and
# tables, and the daemon over DDS, and takes nothing from elsewhere; so does the program percuss, before numpy is there.
# The oldest and the newest CPython take the same wheel and compile each of its modules. Started by run.sh.
set -eu
PYTHON=$PERCUSS_VENV/bin/python sh "$PERCUSS_SOURCE/deploy/wheel.sh" "$PERCUSS_BUILD" "$PWD/wheels" >log
wheel=$(cat log)
case $wheel in
*/percuss-*-py3-none-manylinux_*.whl) ;;
*) echo "not a wheel for machines like this one: $wheel" >&2 && exit 1 ;;
esac
python3 -m venv empty
pip=$PWD/empty/bin/pip
export PIP_DISABLE_PIP_VERSION_CHECK=1
"$pip" install --no-index --no-deps "$wheel" >>log
(
    unset PERCUSS_LIBRARY PYTHONPATH LD_LIBRARY_PATH
    for from in --local "--domain $PERCUSS_DOMAIN"; do
        empty/bin/percuss query $from --a steel-sphere --b al-beam --speed 0.2 --json >answer
        grep -q '"restitution": 0.73936' answer || {
            cat answer >&2
            exit 1
        }
    done
    # the table of a rod that yields is one of those inside
    empty/bin/percuss query --local --a steel-sphere --b al-rod-1 --speed 0.2 --contact-model table >answer
    ! ldd empty/lib/python3.*/site-packages/percuss/bin/percuss | grep -E 'not found|lib(percuss|ddsc|jansson).* => /(usr/)?lib'
)
# the tag says any Python 3, and requires-python which: the wheel's own program starts by each
. "$PERCUSS_SOURCE/client/python/tests/pythons.sh"
least=$(sed -n 's/^requires-python = ">=3\.\([0-9]*\)"$/\1/p' "$PERCUSS_SOURCE/client/python/pyproject.toml")
found | awk -v least="$least" '$1 >= least' | sed '1!{$!d}' >pythons
while read -r minor python; do
    rm -rf other
    "$python" -m venv --without-pip other
    "$pip" --python other/bin/python install --no-index --no-deps "$wheel" >>log </dev/null
    other/bin/python -W error -m compileall -q -f other/lib/python3.*/site-packages/percuss
    env -u PERCUSS_LIBRARY -u PYTHONPATH -u LD_LIBRARY_PATH other/bin/percuss query --local --a steel-sphere --b al-beam \
        --speed 0.2 --json >answer
    grep -q '"restitution": 0.73936' answer
    echo "CPython 3.$minor takes the wheel"
done <pythons
# what else it needs comes from an index, which may be away for a moment
for pause in 5 15 0; do
    "$pip" install numpy >>log 2>&1 && break
    [ $pause -gt 0 ] || {
        echo "skipped: pip reaches no package index: $(grep -i error log | tail -n 1)" >&2
        exit 77
    }
    sleep $pause
done
unset PERCUSS_LIBRARY PYTHONPATH LD_LIBRARY_PATH
cat >ask.py <<'END'
import sys
from pathlib import Path

import percuss
from percuss import measured

inside = Path(percuss.__file__).parents[1]
assert inside.is_relative_to(sys.prefix), inside


def ask(client):
    bodies = client.bodies()
    # a rod that yields needs a table
    questions = [percuss.contact_pair(bodies["steel-sphere"], bodies[name], 0.2) for name in ("al-beam", "al-rod-1")]
    questions[1].options.contact_model = percuss.ContactModel.TABLE
    return [client.solve(one, 60.0).raise_for_status().contacts[0].restitution for one in questions]


with percuss.Local() as local:
    own = ask(local)
    compared = measured.compare({"speed": [0.2], "restitution": [0.7]}, "steel-sphere", "al-beam", local)
    assert compared.simulated.restitution[0] == own[0], compared
with percuss.connect(timeout=10.0) as client:
    bodies = client.bodies()
    asked = client.solve(percuss.contact_pair(bodies["steel-sphere"], bodies["al-beam"], 0.2)).contacts[0].restitution
    assert asked == own[0], (asked, own)
print(own)

# of the libraries that are loaded, only those that every machine has are not in the environment
maps = Path("/proc/self/maps").read_text().split("\n")
loaded = {line.split(maxsplit=5)[5] for line in maps if line.count("/") and ".so" in line}
foreign = {one for one in loaded if not one.startswith(str(inside))}
allowed = ("libc.", "libm.", "ld-", "libdl.", "libpthread.", "librt.", "libresolv.", "libstdc++.", "libgcc_s.", "libz.")
# and those of Python's own modules
python = {"libexpat", "libffi", "libbz2", "liblzma", "libcrypto", "libssl", "libuuid", "libmpdec", "libsqlite3"}
others = {
    one
    for one in foreign
    if not Path(one).name.startswith(allowed)
    and Path(one).name.split(".")[0].split("-")[0] not in python
    and "/lib-dynload/" not in one
    and "/libpython" not in one
}
assert not others, others
for name in ("libpercuss.so", "libpercuss-local.so", "libddsc", "libopenblas", "libhdf5"):
    assert any(name in one and one.startswith(str(inside)) for one in loaded), (name, sorted(loaded))
END
empty/bin/python ask.py
