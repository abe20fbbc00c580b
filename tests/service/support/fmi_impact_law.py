# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss_impact_law.fmu in FMPy. usage: fmi_impact_law.py FMU PERCUSS LIBRARY DOMAIN, beside a daemon"""

import math
import sys

import fmpy
import numpy as np
from fmpy.validation import validate_fmu

from fmi_lib import Unpacked, ask, close, query

FMU, PERCUSS, LIBRARY, DOMAIN = sys.argv[1:]
SPEED, GAP = 0.3, 1e-3
PAIR = ("--a", "steel-sphere", "--b", "al-beam", "--at", "0.25")
RESULTS = ["impulse", "restitution", "duration", "sub_impacts", "error", "gap_rate_before", "gap_rate_after", "impacts"]
# a sphere of 15 mm on a beam of 10 mm radius and 1 m length, a quarter along it
POSES = {"a.position[1]": -0.25, "a.position[3]": 0.025, "a.velocity[3]": -SPEED, "point[1]": -0.25, "point[3]": 0.010,
         "normal[3]": 1.0}


def check_values(values, reply):
    contact = reply["contacts"][0]
    close("impulse", values[0], contact["impulse"], 1e-9)
    close("restitution", values[1], contact["restitution"], 1e-9)
    close("duration", values[2], contact["end_time"], 1e-9)
    assert values[3] == contact["sub_impact_count"]
    close("error", values[4], reply["error"]["restitution_time"] + reply["error"]["restitution_modes"], 1e-9)
    close("gap rate", values[6], contact["restitution"] * SPEED, 1e-9)
    assert values[5] == -SPEED and values[7] == 1


def check_simulated(reply):
    """A gap that closes at a constant rate: one impact at its root, by every kind of importer."""
    columns = [("time", float), ("gap", float), ("gap_rate", float)]
    signal = np.array([(0.0, GAP, -SPEED), (0.01, GAP - 0.01 * SPEED, -SPEED)], dtype=columns)
    ways = [({"fmi_type": "CoSimulation"}, 2e-4), ({"fmi_type": "CoSimulation", "use_event_mode": True}, 2e-4),
            ({"fmi_type": "ModelExchange", "solver": "CVode"}, 1e-12),
            ({"fmi_type": "ModelExchange", "solver": "Euler"}, 2e-4)]
    for named, late in ways:
        result = fmpy.simulate_fmu(FMU, start_values={"at": 0.25}, input=signal, stop_time=0.01, output_interval=1e-4,
                                   output=RESULTS, **named)
        after = result[np.argmax(result["impacts"] > 0)]
        # steps find it at their end, of which one may pass before it shows; CVODE finds the root
        assert -1e-12 <= after["time"] - GAP / SPEED <= late, (named, after["time"])
        check_values([after[name] for name in RESULTS], reply)
        assert result[-1]["impacts"] == 1, "another impact before the bodies separated"


def strike(unpacked, start, inputs):
    """One impact in event mode; the values after it, and the instance."""
    fmu = unpacked.instance(event_mode=True, early_return=True, start=start)
    fmu.enterStepMode()
    fmu.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.1)
    fmu.enterEventMode()
    unpacked.set(fmu, {"gap": 0.0, **inputs})
    fmu.updateDiscreteStates()
    return unpacked.get(fmu, *RESULTS), fmu


def check_again(unpacked, reply):
    """What has separated may touch again; what has not, not. States are kept between."""
    values, fmu = strike(unpacked, {"at": 0.25}, {"gap_rate": -SPEED})
    check_values(values, reply)
    fmu.updateDiscreteStates()
    assert unpacked.get(fmu, "impacts") == 1
    unpacked.set(fmu, {"gap_rate": values[6]})
    fmu.updateDiscreteStates()
    state = fmu.getFMUState()
    seen = []
    for _ in range(2):
        unpacked.set(fmu, {"gap_rate": -2 * SPEED})
        fmu.updateDiscreteStates()
        seen.append(unpacked.get(fmu, *RESULTS))
        fmu.setFMUState(state)
    assert seen[0] == seen[1] and seen[0][7] == 2
    close("restitution", seen[0][1], query(PERCUSS, 2 * SPEED, *PAIR)["contacts"][0]["restitution"], 1e-9)
    fmu.freeFMUState(state)
    fmu.freeInstance()


def check_ways(unpacked, reply):
    """By poses, by the simulator's own mass, and by a daemon: the same impact."""
    values, fmu = strike(unpacked, {"by_poses": True}, POSES)
    check_values(values, reply)
    fmu.freeInstance()
    service = {"at": 0.25, "service": True, "domain": int(DOMAIN), "library": LIBRARY}
    values, fmu = strike(unpacked, service, {"gap_rate": -SPEED})
    check_values(values, reply)
    fmu.freeInstance()
    # twice W: half the impulse that stops the approach
    inverse_mass = 2 * reply["contacts"][0]["inverse_effective_mass"]
    values, fmu = strike(unpacked, {"at": 0.25}, {"gap_rate": -SPEED, "inverse_effective_mass": inverse_mass})
    close("impulse", values[0], (1 + values[1]) * SPEED / inverse_mass, 1e-12)
    assert not math.isclose(values[1], reply["contacts"][0]["restitution"], rel_tol=1e-3)
    fmu.freeInstance()


def check_friction(unpacked):
    """At an angle along the beam: the impulse of percuss query, and its moments about both centres of mass."""
    names = [f"{name}[{i}]" for name in ("impulse_vector", "angular_impulse_a", "angular_impulse_b") for i in (1, 2, 3)]
    slanted = {**POSES, "a.velocity[1]": 0.5 * SPEED, "a.velocity[3]": -math.sqrt(0.75) * SPEED}
    values, fmu = strike(unpacked, {"by_poses": True, "friction": 0.2}, slanted)
    reply = query(PERCUSS, SPEED, *PAIR, "--angle", "30", "--friction", "0.2")
    contact = reply["contacts"][0]
    vectors = np.reshape(unpacked.get(fmu, *names), (3, 3))
    np.testing.assert_allclose(vectors[0], contact["impulse_vector"], rtol=1e-9, atol=1e-12)
    assert abs(vectors[0][0]) > 0.1 * vectors[0][2], "nothing along the surface"
    np.testing.assert_allclose(vectors[1], np.cross([0, 0, -0.015], vectors[0]), atol=1e-15)
    # about the origin, the beam's centre, what A gets B loses
    about = vectors[1] + np.cross([-0.25, 0, 0.025], vectors[0])
    np.testing.assert_allclose(vectors[2], -about, atol=1e-15)
    close("friction", unpacked.get(fmu, "friction_loss"), reply["energy"]["friction"], 1e-9)
    close("gap rate", values[6], contact["restitution_kinematic"] * math.sqrt(0.75) * SPEED, 1e-9)
    fmu.freeInstance()
    # none: the impulse is along the normal, and has no moment about the centre of a sphere
    values, fmu = strike(unpacked, {"by_poses": True}, slanted)
    vectors = np.reshape(unpacked.get(fmu, *names), (3, 3))
    np.testing.assert_allclose(vectors[0], [0, 0, values[0]], atol=1e-15)
    assert not vectors[1].any()
    fmu.freeInstance()
    unpacked.refused("friction: 0.2: only 0 is allowed without by_poses", unpacked.instance, start={"friction": 0.2})
    unpacked.refused("friction: 0.2: only 0 is allowed with inverse_effective_mass and without inverse_mass_tangential",
                     strike, unpacked, {"by_poses": True, "friction": 0.2}, {**slanted, "inverse_effective_mass": 10.0})
    unpacked.refused("inverse_mass_tangential: 20, 0: inverse_effective_mass is needed too", strike, unpacked,
                     {"by_poses": True, "friction": 0.2}, {**slanted, "inverse_mass_tangential[1]": 20.0})
    unpacked.refused("friction", strike, unpacked, {"by_poses": True, "friction": -0.2}, slanted)


def check_own_masses(unpacked):
    """Friction of bodies in joints, by the simulator's own inverse masses: the answer to a request with that matrix."""
    names = [f"impulse_vector[{i}]" for i in (1, 2, 3)]
    slanted = {**POSES, "a.velocity[1]": 0.1, "a.velocity[2]": -0.05, "a.velocity[3]": -SPEED}
    tangent = (0.6, 0.8, 0.0)
    matrix = [[10.0, 0.5, -1.0], [0.5, 30.0, 2.0], [-1.0, 2.0, 25.0]]
    own = {**{f"tangent[{i + 1}]": tangent[i] for i in range(3)}, "inverse_effective_mass": 10.0,
           "inverse_mass_tangential[1]": 30.0, "inverse_mass_tangential[2]": 25.0, "inverse_mass_coupling[1]": 0.5,
           "inverse_mass_coupling[2]": -1.0, "inverse_mass_coupling[3]": 2.0}
    place = {name: [POSES.get(f"{name}[{i}]", 0.0) for i in (1, 2, 3)] for name in ("a.position", "point", "normal")}
    question = {
        "bodies": [{"id": "steel-sphere", "position": place["a.position"], "velocity": [0.1, -0.05, -SPEED]},
                   {"id": "al-beam"}],
        "contacts": [{"a": 0, "b": 1, "point": place["point"], "normal": place["normal"], "friction": 0.2,
                      "tangent": tangent}],
        "delassus": matrix}
    reply = ask(PERCUSS, question)
    values, fmu = strike(unpacked, {"by_poses": True, "friction": 0.2}, {**slanted, **own})
    np.testing.assert_allclose(unpacked.get(fmu, *names), reply["contacts"][0]["impulse_vector"], rtol=1e-9, atol=1e-12)
    assert reply["delassus_source"] == "client" and reply["contacts"][0]["friction"] == 0.2
    along = reply["contacts"][0]["impulse_tangential"]
    assert math.hypot(*along) > 0.05 * values[0], along
    fmu.freeInstance()
    # a matrix that is none is the service's to refuse
    unpacked.refused("positive semidefinite", strike, unpacked, {"by_poses": True, "friction": 0.2},
                     {**slanted, **own, "inverse_mass_coupling[1]": 20.0})


def check_errors(unpacked):
    for by_poses in (False, True):
        unpacked.refused("body_a: 'nobody' is not in the catalogue", unpacked.instance,
                         start={"body_a": "nobody", "by_poses": by_poses})
    unpacked.refused("body_b: 'al-baem' is not in the catalogue (did you mean 'al-beam'?), which has: ",
                     unpacked.instance, start={"body_b": "al-baem"})
    unpacked.refused("domain: ", unpacked.instance, start={"service": True, "domain": 999, "library": LIBRARY})
    unpacked.refused("'libm.so.6' is no libpercuss", unpacked.instance, start={"service": True, "library": "libm.so.6"})
    unpacked.refused("inverse_effective_mass: -1", strike, unpacked, {},
                     {"gap_rate": -SPEED, "inverse_effective_mass": -1.0})
    unpacked.refused("normal", strike, unpacked, {"by_poses": True}, {**POSES, "normal[3]": 0.5, "a.velocity[3]": -1.0})


problems = validate_fmu(FMU)
assert not problems, problems
reply = query(PERCUSS, SPEED, *PAIR)
check_simulated(reply)
unpacked = Unpacked(FMU)
check_again(unpacked, reply)
check_ways(unpacked, reply)
check_friction(unpacked)
check_own_masses(unpacked)
check_errors(unpacked)
print(f"e = {reply['contacts'][0]['restitution']:.6f}")
