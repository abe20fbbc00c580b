# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo: rigid bodies with its contact, by what percuss export says."""

import math
import time

import mujoco
import numpy as np
from scenes import BAR, SPEED, STRIKER, exported

VERSION = f"MuJoCo {mujoco.__version__}"
CASES = [(step,) for step in (1.0, 0.5, 0.2)]


def run(scene, step):
    if scene == "row":
        raise NotImplementedError("its contacts are fitted pair by pair")
    told, text = exported("mujoco", scene)
    masses = (STRIKER, STRIKER if scene == "balls" else BAR)
    bodies = "".join(
        f'<body pos="0 0 {z}"><freejoint/><geom name="{name}" type="sphere" size="0.5" mass="{mass}"/></body>'
        for name, mass, z in zip("AB", masses, (1.0, 0.0))
    )
    model = mujoco.MjModel.from_xml_string(f'<mujoco><option gravity="0 0 0"/>{text}<worldbody>{bodies}</worldbody></mujoco>')
    model.opt.timestep = told["step"] * step
    data = mujoco.MjData(model)
    data.qvel[2] = -SPEED[scene]
    steps = math.ceil(2.0 * told["duration"] / model.opt.timestep)
    began = time.process_time()
    mujoco.mj_step(model, data, steps)
    seconds = time.process_time() - began
    return np.array([(data.qvel[8] * -1.0 + data.qvel[2]) / SPEED[scene]]), seconds
