# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo: rigid bodies with its contact, by what percuss export says."""

import math
import time

import mujoco
import numpy as np
from scenes import BAR, DROP, END, GRAVITY, SPEED, STRIKER, exported, height_left

VERSION = f"MuJoCo {mujoco.__version__}"
SOFT = 1e-4  # s, the step of a simulator of bounces
CASES = [(step,) for step in (1.0, 0.5, 0.2)]


def model_of(text, bodies, gravity, step):
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="0 0 {-gravity}"/>{text}<worldbody>{bodies}</worldbody></mujoco>'
    )
    model.opt.timestep = step
    return model, mujoco.MjData(model)


def ball(name, mass, z):
    return f'<body pos="0 0 {z}"><freejoint/><geom name="{name}" type="sphere" size="0.5" mass="{mass}"/></body>'


def stepped(model, data, end):
    steps = math.ceil(end / model.opt.timestep)
    began = time.process_time()
    mujoco.mj_step(model, data, steps)
    return time.process_time() - began


def bounce(step):
    # softened: a contact of 50 such steps
    told, text = exported("mujoco", "bounce", "--step", str(SOFT))
    ground = '<geom name="B" type="plane" size="1 1 1"/>'
    model, data = model_of(text, ground + ball("A", STRIKER, 0.5 + DROP), GRAVITY, told["step"] * step)
    seconds = stepped(model, data, END)
    return np.array([(data.qpos[2] - 0.5 + 0.5 * data.qvel[2] ** 2 / GRAVITY) / height_left()]), seconds


def run(scene, step):
    if scene == "row":
        raise NotImplementedError("its contacts are fitted pair by pair")
    if scene == "bounce":
        return bounce(step)
    told, text = exported("mujoco", scene)
    bodies = ball("A", STRIKER, 1.0) + ball("B", STRIKER if scene == "balls" else BAR, 0.0)
    model, data = model_of(text, bodies, 0.0, told["step"] * step)
    data.qvel[2] = -SPEED[scene]
    seconds = stepped(model, data, 2.0 * told["duration"])
    return np.array([(data.qvel[8] * -1.0 + data.qvel[2]) / SPEED[scene]]), seconds
