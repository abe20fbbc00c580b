#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# A newcomer's first answer about a part of their own, on an empty Debian 12: a brass ball of 16 mm hits a steel arm at
# 0.3 m/s; with percuss, and with what a newcomer would take instead, as each one's own pages say. A rig's operator, who has
# bounces of that ball and seeks its yield; a simulator's author, with a program in C and a prefix of their own; and one
# with a simulation in MuJoCo. Run by stages.sh inside an empty root.
# usage: newcomer.sh WAY    (source, packages FOLDER, wheel FILE; rig FILE, author, simulation FILE; mujoco, fmpy FOLDER,
#                           gmsh)
set -eu
cd "$(dirname "$0")/../.."
. tests/documents.sh
way=$1
given=${2:-}
export DEBIAN_FRONTEND=noninteractive
work=$(mktemp -d)
root=$PWD

seconds() {
    date +%s.%N
}
# what is installed counts with what it unpacks to, on this disk
room() {
    df --output=used -B 1048576 / | tail -n 1
}
packages() {
    apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@" >&2
}
python_packages() {
    packages python3-venv
    python3 -m venv "$work/venv"
    "$work/venv/bin/pip" install --quiet "$@" >&2
}

# the files that a newcomer writes lie in $work/own: their lines are counted
mkdir "$work/own"
own_part() {
    commands README.md 'bench.yaml' | sed -n '/^cat >/,/^END/p' | (cd "$work/own" && sh)
}
PART='query --local --catalogue bench.yaml --a ball --b arm --speed 300mm/s --at 75%'

install_source() {
    sh deploy/quickstart.sh >&2
}
answer_source() {
    own_part
    # words of a command line
    # shellcheck disable=SC2086
    (cd "$work/own" && "$root/build/bin/percuss" $PART) >"$work/said"
    grep '^  restitution' "$work/said"
}

install_packages() {
    packages "$given"/percuss-tools_*.deb "$given"/libpercuss1_*.deb "$given"/libpercuss-local1_*.deb \
        "$given"/percuss-daemon_*.deb
}
answer_packages() {
    own_part
    # shellcheck disable=SC2086
    (cd "$work/own" && percuss $PART) >"$work/said"
    grep '^  restitution' "$work/said"
}

install_wheel() {
    python_packages "$given"
}
answer_wheel() {
    own_part
    cat >"$work/own/ask.py" <<'END'
import percuss

with percuss.Local("bench.yaml") as client:
    question = percuss.contact_pair("ball", "arm", speed="300mm/s", at="75%", client=client)
    print(client.solve(question).raise_for_status().contacts[0].restitution)
END
    (cd "$work/own" && "$work/venv/bin/python" ask.py)
}

# heights that the ball fell and rose on a block of steel; e by the catalogue's yield is not theirs, and the fit finds the one
# that is (240 MPa: bounces.csv holds percuss' own answers with 1 % of noise)
install_rig() {
    install_wheel
}
answer_rig() {
    cat >"$work/own/rig.yaml" <<'END'
materials:
  brass: {young: 100 GPa, poisson: 0.34, density: 8.5 g/cm^3, yield: 200 MPa}
  steel: {young: 206 GPa, poisson: 0.3, density: 7.85 g/cm^3, yield: 1.2 GPa}
bodies:
  ball:  {shape: sphere, material: brass, diameter: 16 mm}
  block: {shape: half-space, material: steel}
END
    cat >"$work/own/bounces.csv" <<'END'
drop [mm];rebound [mm];sub_impacts
20;8.6;1
50;18.2;1
100;32.9;1
150;45.1;1
200;57.9;1
300;79.6;1
END
    PATH=$work/venv/bin:$PATH
    cd "$work/own"
    set -- bounces.csv --local --catalogue rig.yaml --a ball --b block
    percuss compare "$@" --uncertainty rebound=1mm >&2
    percuss calibrate "$@" --fit yield:ball >"$work/said"
    cat "$work/said" >&2
    awk '/^yield of ball/ { print "yield of ball", $5 / 1e6, "MPa, 95 %:", $6 / 1e6, "to", $8 / 1e6 }' "$work/said"
    cd "$root"
}

# the build goes into a prefix of the author's, and their program finds it by pkg-config
install_author() {
    install_source
    cmake --install build --prefix "$work/prefix" >&2
}
answer_author() {
    own_part
    cat >"$work/own/ask.c" <<'END'
#include <percuss/local.h>
#include <stdio.h>

int main(void)
{
    struct percuss_local_config config = percuss_local_config_default();
    struct percuss_client *client;
    struct percuss_body_list bodies;
    struct percuss_request request;
    struct percuss_reply reply;
    config.catalogue = "bench.yaml";
    if (percuss_local_open(&config, &client) || percuss_bodies(client, 1.0, &bodies))
        return fprintf(stderr, "%s\n", percuss_error_text());
    struct percuss_pair pair = percuss_pair_default(percuss_body_find(&bodies, "ball"), percuss_body_find(&bodies, "arm"));
    pair.speed = 0.3;
    pair.at_b = 0.75;
    if (percuss_contact_pair(&pair, &request) || percuss_solve(client, &request, 60.0, &reply))
        return fprintf(stderr, "%s\n", percuss_error_text());
    printf("%g +- %.2g\n", reply.contacts[0].restitution, reply.error.restitution_total);
    percuss_reply_free(&reply);
    percuss_body_list_free(&bodies);
    percuss_client_free(client);
    return 0;
}
END
    (
        cd "$work/own"
        export PKG_CONFIG_PATH="$work/prefix/lib/pkgconfig"
        # words of a command line
        # shellcheck disable=SC2046
        cc ask.c $(pkg-config --cflags --libs percuss-local) -o "$work/ask"
        "$work/ask"
    )
}

# the example that asks percuss out of MuJoCo, as it stands
install_simulation() {
    python_packages "$given" mujoco
}
answer_simulation() {
    "$work/venv/bin/python" client/python/examples/mujoco_pendulum.py config/catalogue.yaml >"$work/said"
    cat "$work/said" >&2
    echo "$(grep -c '^ *[0-9]' "$work/said") impacts, e of the first $(awk '/^ *[0-9]/ { print $3; exit }' "$work/said")"
}

# rigid bodies: the arm does not vibrate, and e is that of solref, which the newcomer chooses
install_mujoco() {
    python_packages mujoco
}
answer_mujoco() {
    cat >"$work/own/ask.py" <<'END'
import mujoco

MODEL = """
<mujoco>
  <option timestep="1e-5" gravity="0 0 0"/>
  <worldbody>
    <geom type="box" size=".1 .006 .004" pos="0 0 -.004" solref="1e-4 .5"/>
    <body pos=".05 0 .0081"><freejoint/><geom type="sphere" size=".008" density="8500" solref="1e-4 .5"/></body>
  </worldbody>
</mujoco>
"""
model = mujoco.MjModel.from_xml_string(MODEL)
data = mujoco.MjData(model)
data.qvel[2] = -0.3
while data.time < 0.01:
    mujoco.mj_step(model, data)
print(data.qvel[2] / 0.3)
END
    (cd "$work/own" && "$work/venv/bin/python" ask.py)
}

# a player of models that others have made: here percuss' own
install_fmpy() {
    packages "$given"/percuss-fmu_*.deb "$given"/libpercuss-local1_*.deb
    python_packages fmpy
}
answer_fmpy() {
    cat >"$work/own/ask.py" <<'END'
import sys

import fmpy

result = fmpy.simulate_fmu(sys.argv[1], stop_time=0.5)
print({name: float(result[name][-1]) for name in result.dtype.names[:3]})
END
    "$work/venv/bin/python" "$work/own/ask.py" /usr/lib/*/percuss/percuss_falling_body.fmu
}

# makes meshes, which is as far as it goes; a finite element program would go on from there
install_gmsh() {
    packages gmsh
}
answer_gmsh() {
    cat >"$work/own/arm.geo" <<'END'
SetFactory("OpenCASCADE");
Box(1) = {0, -6, -4, 200, 12, 8};
Physical Volume("arm") = {1};
Mesh.CharacteristicLengthMax = 4;
END
    gmsh -3 -order 2 "$work/own/arm.geo" -o "$work/arm.msh" >&2
    echo "$(sed -n '/^\$Nodes/{n;s/^[0-9]* \([0-9]*\) .*/\1/p}' "$work/arm.msh") nodes"
}

began=$(seconds)
before=$(room)
"install_$way"
installed=$(seconds)
"answer_$way" >"$work/answer"
answered=$(seconds)
lines=$(cat "$work"/own/* 2>/dev/null | grep -c . || true)
# "newcomer |" for stages.sh
awk -v way="$way" -v a="$began" -v b="$installed" -v c="$answered" -v room=$(($(room) - before)) -v lines="$lines" \
    -v answer="$(tail -n 1 "$work/answer" | sed 's/^ *restitution *//')" 'BEGIN {
    printf "newcomer | %s | %.0f s | %d MB | %.1f s | %d | %s |\n", way, b - a, room, c - b, lines, answer }'
