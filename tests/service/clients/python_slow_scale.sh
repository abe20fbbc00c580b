#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A simulation in Python whose daemon is killed between two impacts: it stops with NoServer where it was, and goes on
# there when a daemon is back, with the impacts that it would have had. Skipped where the Python tests have no virtual
# environment.
. "$(dirname "$0")/../support/lib.sh"
venv=$build/python-venv
[ -e "$venv/wanted" ] || {
    say "no virtual environment (see the test python/environment): skipped"
    exit 77
}
PATH=$venv/bin:$PATH
PERCUSS_LIBRARY=$build/client/libpercuss.so
PERCUSS_DOMAIN=$domain
PYTHONPATH=$source_dir/client/python/examples
export PATH PERCUSS_LIBRARY PERCUSS_DOMAIN PYTHONPATH
prints() { # PATTERN
    grep -q "$1" "$out" || fail "stdout does not show: $1"
}
cd "$work"

# prints each impact; where nobody answers, says so and waits for a line before it calls again
cat >bench.py <<'END'
import sys
import percuss
from percuss.slowscale import SlowScale
from percuss.world import run
from two_spheres import Spheres

def show(report):
    print("impact", *(float(e).hex() for e in report.restitution), *(float(p).hex() for p in report.impulse), flush=True)

where = sys.argv[1:]
with percuss.Local(*where) if where else percuss.Client() as client:
    with percuss.Local("catalogue.yaml") as known:
        world = Spheres(known.bodies(), (0.3, 0.45), 0.2, 2e-4)
    names = ["al-beam", "steel-sphere", "steel-sphere"]
    with SlowScale(names, world, client, report=show, reconnect=1.0 if not where else 10.0) as slow:
        while world.now() < 0.05:
            try:
                run(world, slow, 0.05, 1e-3)
            except percuss.NoServer as problem:
                print("waits at", world.now(), problem, flush=True)
                sys.stdin.readline()
        print(slow.counts)
END
say "nobody there: it waits at the impact, and goes on when a daemon is there"
mkfifo pace
python bench.py <pace >bench.out 2>"$err" 9>&- &
others=$!
exec 8>pace
said() {
    grep -q "$1" bench.out
}
wait_for 400 said "^waits at 0.001.* no percussd" || fail "it does not wait: $(cat bench.out)"
start_daemon
echo >&8
# the machine may be slow to let them find each other: then it waits again
until wait_for 100 said "^Counts"; do
    kill -0 "$others" 2>/dev/null || fail "it has ended: $(cat bench.out)"
    echo >&8
done
exec 8>&-
wait "$others" || fail "the simulation failed"
others=
stop_daemon
grep -q "Counts(impacts=1, .*declared=0)" bench.out || fail "$(cat bench.out)"

# the touch is found anew when it is asked again, and its gap may be another one within rounding (1e-16 m)
say "the impact is the one that it would have been, but for rounding"
expect 0 python bench.py catalogue.yaml
grep "^impact" bench.out >waited
grep "^impact" "$out" | paste - waited | python -c '
numbers = [float.fromhex(one) for one in input().split() if one != "impact"]
half = len(numbers) // 2
assert half == 4 and all(abs(a - b) < 1e-11 for a, b in zip(numbers[:half], numbers[half:])), numbers' ||
    fail "another impact"

say "Ctrl-C ends a simulation within its callbacks"
cat >interrupted.py <<'END'
import os, signal
import percuss
from percuss.slowscale import SlowScale
from percuss.world import run
from two_spheres import Spheres

class Interrupted(Spheres):
    def gap_rates(self, contacts):
        os.kill(os.getpid(), signal.SIGINT)
        return super().gap_rates(contacts)

with percuss.Local("catalogue.yaml") as client:
    world = Interrupted(client.bodies(), (0.3,), 0.2, 2e-4)
    with SlowScale(["al-beam", "steel-sphere"], world, client) as slow:
        try:
            run(world, slow, 0.05, 1e-3)
        except KeyboardInterrupt:
            print("interrupted at", world.now(), slow.counts.impacts)
END
expect 0 python interrupted.py
prints "^interrupted at 0\.001.* 0$"
