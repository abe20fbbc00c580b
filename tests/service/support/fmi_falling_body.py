# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss_falling_body.fmu in FMPy and CasADi. usage: fmi_falling_body.py FMU PERCUSS"""

import math
import os
import re
import sys
import tempfile
import zipfile

import casadi
import fmpy
from fmpy.fmi3 import fmi3FMUState
from fmpy.validation import validate_fmu

from fmi_lib import Unpacked, close, query

FMU, PERCUSS = sys.argv[1:]
GRAVITY, HEIGHT = 9.81, 0.1
OUTPUTS = ["height", "velocity", "restitution", "gap_rate_before", "gap_rate_after", "impacts", "energy",
           "energy_lost", "resting", "duration", "sub_impacts"]


def simulate(**named):
    return fmpy.simulate_fmu(FMU, stop_time=1.0, output=OUTPUTS, **named)


def bounces(result):
    """The rows after each impact."""
    return [after for before, after in zip(result, result[1:]) if after["impacts"] > before["impacts"]]


def check_description():
    problems = validate_fmu(FMU)
    assert not problems, problems


def check_event_mode():
    """Every touch ends a step: its time and height by closed forms, its e by percuss query."""
    result = simulate(fmi_type="CoSimulation", use_event_mode=True, early_return_allowed=True, output_interval=0.01)
    rows = bounces(result)
    # rounding of a few operations
    close("time of touch", rows[0]["time"], math.sqrt(2 * HEIGHT / GRAVITY), 1e-15)
    assert len(rows) >= 4 and [row["impacts"] for row in rows] == list(range(1, len(rows) + 1)), rows
    height, time = HEIGHT, 0.0
    for row in rows:
        speed = math.sqrt(2 * GRAVITY * height)
        # rounding grows by what the speeds shrink
        close("speed", -row["gap_rate_before"], speed, 1e-12)
        reply = query(PERCUSS, -row["gap_rate_before"], "--a", "steel-sphere", "--b", "al-beam-pinned")
        contact = reply["contacts"][0]
        close("restitution", row["restitution"], contact["restitution"], 1e-9)
        close("duration", row["duration"], contact["end_time"], 1e-9)
        assert row["sub_impacts"] == contact["sub_impact_count"]
        height *= row["restitution"] ** 2
        if not row["resting"]:
            close("height of the bounce", row["velocity"] ** 2 / (2 * GRAVITY), height, 1e-12)
    energy = result["energy"] + result["energy_lost"]
    # its own sum in another order
    assert abs(energy - energy[0]).max() <= 1e-14 * energy[0], energy
    assert result[-1]["resting"] and result[-1]["energy"] == 0.0 and result[-1]["height"] == 0.0
    return rows


def check_plain_steps(rows):
    """Without event mode the same bounces to the bit, whatever the steps."""
    for interval in (0.01, 0.003, 0.25):
        last = simulate(fmi_type="CoSimulation", output_interval=interval)[-1]
        for name in ("restitution", "gap_rate_before", "impacts", "energy_lost", "duration"):
            assert last[name] == rows[-1][name], (interval, name, last[name], rows[-1][name])
    # event mode without early return: handled within the step, too
    last = simulate(fmi_type="CoSimulation", use_event_mode=True, output_interval=0.01)[-1]
    assert last["energy_lost"] == rows[-1]["energy_lost"]


def check_model_exchange(rows):
    """By CVODE: its accuracy for the first touch, and e for the speed it comes with."""
    found = bounces(simulate(fmi_type="ModelExchange", solver="CVode", relative_tolerance=1e-9, output_interval=0.01))
    # FMPy lets CVODE take absolute errors as relative ones: some hundred steps of 1e-9
    close("time of touch", found[0]["time"], rows[0]["time"], 1e-7)
    close("speed", found[0]["gap_rate_before"], rows[0]["gap_rate_before"], 1e-7)
    for row in found[:3]:
        reply = query(PERCUSS, -row["gap_rate_before"], "--a", "steel-sphere", "--b", "al-beam-pinned")
        close("restitution", row["restitution"], reply["contacts"][0]["restitution"], 1e-9)


def check_fixed_steps():
    """Euler's steps of 1/240 s see each touch some millimetres too late. In flight each brings g^2 h^2 / 2 of its own, by
    moving with the old velocity; the bounces keep the sum of what is there and what is lost."""
    result = simulate(fmi_type="ModelExchange", solver="Euler", step_size=1 / 240, output_interval=1 / 240,
                      record_events=False)
    mass = result["energy"][0] / (GRAVITY * HEIGHT)
    brought = [mass * (GRAVITY / 240) ** 2 / 2 * i for i in range(len(result))]
    total = result["energy"] + result["energy_lost"] - brought
    assert result["impacts"][-1] > 10 and not result["resting"][-1], result[-1]
    assert abs(total - total[0]).max() <= 1e-12 * total[0], total / total[0]
    # nothing is ever found below the touch
    assert result["height"].min() >= 0.0, result["height"].min()


def walk(unpacked, fmu, time, steps):
    """All outputs after each of some steps."""
    rows = []
    for i in range(steps):
        fmu.doStep(currentCommunicationPoint=time, communicationStepSize=0.02)
        time += 0.02
        rows.append(unpacked.get(fmu, *OUTPUTS))
    return rows


def check_states(unpacked):
    """From a state that was kept, in this instance and as bytes in another one, all goes on to the bit."""
    fmu = unpacked.instance()
    walk(unpacked, fmu, 0.0, 10)
    state = fmu.getFMUState()
    kept = fmu.serializeFMUState(state)
    wanted = walk(unpacked, fmu, 0.2, 10)
    assert wanted[0][5] < wanted[-1][5], "no impact after the state"
    fmu.setFMUState(state)
    assert walk(unpacked, fmu, 0.2, 10) == wanted
    other = unpacked.instance(start={"body_b": "steel-wall", "height": 0.5})
    copy = fmi3FMUState()
    other.deserializeFMUState(kept, copy)
    other.setFMUState(copy)
    assert unpacked.get(other, "body_b") in ("al-beam-pinned", b"al-beam-pinned")
    assert walk(unpacked, other, 0.2, 10) == wanted
    again = other.serializeFMUState(copy)
    assert again == kept
    for damaged in (kept[:-1], b"x" + kept[1:], kept[:64] + b"\x05" + kept[65:]):
        unpacked.refused("are no state of 'percuss falling body", other.deserializeFMUState, damaged, fmi3FMUState())
    for one, its in ((fmu, state), (other, copy)):
        one.freeFMUState(its)
        one.terminate()
        one.reset()
        assert unpacked.get(one, "height", "impacts") == [0.1, 0]
        one.freeInstance()


def check_catalogue(unpacked):
    """A file of the user's own."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write("materials:\n  glass: {young: 48e9, poisson: 0.2, density: 2800}\n"
                   "bodies:\n  ball: {shape: sphere, material: glass, radius: 0.01}\n"
                   "  bar: {shape: beam, material: glass, radius: 0.008, length: 0.5, ends: clamped}\n")
        file.flush()
        fmu = unpacked.instance(start={"catalogue": file.name, "body_a": "ball", "body_b": "bar"})
        fmu.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.15)
        speed, restitution, impacts = unpacked.get(fmu, "gap_rate_before", "restitution", "impacts")
        assert impacts == 1
        reply = query(PERCUSS, -speed, "--catalogue", file.name, "--a", "ball", "--b", "bar")
        close("restitution", restitution, reply["contacts"][0]["restitution"], 1e-9)
        fmu.freeInstance()


def check_errors(unpacked):
    refused = unpacked.refused
    refused("'nobody' is not in the catalogue, which has: al-beam", unpacked.instance, start={"body_b": "nobody"})
    refused("'al-beam' is free and would fly away", unpacked.instance, start={"body_b": "al-beam"})
    refused("gravity: -1: a number > 0 is needed", unpacked.instance, start={"gravity": -1.0})
    refused("height: -1: a number >= 0 is needed", unpacked.instance, start={"height": -1.0})
    refused("at: ", unpacked.instance, start={"at": 2.0})
    refused("nowhere.yaml", unpacked.instance, start={"catalogue": "/nowhere.yaml"})
    refused("library: ", unpacked.instance, start={"service": True, "library": "libnowhere.so"})
    fmu = unpacked.instance()
    refused("gravity is not allowed now: the FMU is in the state 'step mode'", unpacked.set, fmu, {"gravity": 1.0})
    refused("energy cannot be set", unpacked.set, fmu, {"energy": 1.0})
    refused("value reference 99", fmu.getFloat64, [99])
    refused("body_a is a String, no Float64", fmu.getFloat64, [unpacked.references["body_a"].valueReference])
    refused("the FMU is at 0", fmu.doStep, currentCommunicationPoint=1.0, communicationStepSize=0.1)
    refused("a step of -0.1 s", fmu.doStep, currentCommunicationPoint=0.0, communicationStepSize=-0.1)
    refused("without event mode", fmu.enterEventMode)
    refused("category 'other' is none of: logStatusError", fmu.setDebugLogging, True, ["other"])
    fmu.setDebugLogging(True, ["logImpacts"])
    fmu.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.2)
    assert any("steel-sphere on al-beam-pinned at 1.4007" in text for text in unpacked.said), unpacked.said
    fmu.freeInstance()
    # from 2 km it comes so fast that several things are to be said
    fmu = unpacked.instance(start={"height": 2000.0})
    fmu.setDebugLogging(True, ["logImpacts"])
    fmu.doStep(currentCommunicationPoint=0.0, communicationStepSize=20.5)
    reply = query(PERCUSS, math.sqrt(2 * GRAVITY * 2000.0), "--a", "steel-sphere", "--b", "al-beam-pinned")
    assert len(reply["warnings"]) > 1 and "\n".join(reply["warnings"]) in unpacked.said, unpacked.said
    fmu.freeInstance()


def check_casadi():
    """CasADi 3.8.2 reads no start values of texts; without them it steps the flight as the closed form."""
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(FMU) as file:
            file.extractall(folder)
        path = os.path.join(folder, "modelDescription.xml")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(re.sub(r"<Start [^>]*/>", "", text))
        model = casadi.DaeBuilder("falling", folder)
        assert model.x() == ["height", "velocity"]
        rate = model.create("rate", ["x", "u"], ["ode"])
        x = casadi.MX.sym("x", 2)
        flight = casadi.integrator("flight", "rk", {"x": x, "ode": rate(x=x)["ode"]}, 0.0, 0.1)
        end = flight(x0=[HEIGHT, -0.2])["xf"]
        # Runge-Kutta is exact for a parabola, but for rounding
        close("height", float(end[0]), HEIGHT - 0.02 - GRAVITY / 2 * 0.01, 1e-13)
        close("velocity", float(end[1]), -0.2 - GRAVITY * 0.1, 1e-13)


check_description()
rows = check_event_mode()
check_plain_steps(rows)
check_model_exchange(rows)
check_fixed_steps()
unpacked = Unpacked(FMU)
check_states(unpacked)
check_catalogue(unpacked)
check_errors(unpacked)
check_casadi()
print(f"{len(rows)} bounces, e = {rows[0]['restitution']:.6f} at first")
