# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Drake: rigid bodies with its point contact, continuous in time, by what percuss export says."""

import re
import time
from importlib.metadata import version

import numpy as np
import pydrake.all as pd
from scenes import BAR, DROP, END, GRAVITY, SPEED, STRIKER, exported, height_left

VERSION = "Drake " + version("drake")
CASES = [(accuracy,) for accuracy in (1e-2, 1e-3, 1e-5)]
RADIUS = 0.5  # m: the numbers are those of the pair
GAP = 1e-9  # m


class World:
    def __init__(self, told, text, gravity):
        self.longest = told["duration"]  # a longer step may miss a contact
        numbers = re.search(r"AddContactMaterial\((\S+) /\* s/m \*/, (\S+) /", text).groups()
        self.properties = pd.ProximityProperties()
        pd.AddContactMaterial(*map(float, numbers), pd.CoulombFriction(0.0, 0.0), self.properties)
        self.builder = pd.DiagramBuilder()
        self.plant, _ = pd.AddMultibodyPlantSceneGraph(self.builder, 0.0)
        self.plant.mutable_gravity_field().set_gravity_vector([0, 0, -gravity])
        self.plant.set_contact_model(pd.ContactModel.kPoint)
        self.balls = []

    def add_ball(self, name, mass):
        inertia = pd.SpatialInertia.SolidSphereWithMass(mass, RADIUS)
        body = self.plant.AddRigidBody(name, self.plant.AddModelInstance(name), inertia)
        self.plant.RegisterCollisionGeometry(body, pd.RigidTransform(), pd.Sphere(RADIUS), name, self.properties)
        self.balls.append(body)

    def add_ground(self):
        ground = self.plant.world_body()
        self.plant.RegisterCollisionGeometry(ground, pd.RigidTransform(), pd.HalfSpace(), "ground", self.properties)

    def simulate(self, places, speed, end, accuracy):
        """Places and speeds of the balls at the end, and the seconds."""
        self.plant.Finalize()
        simulator = pd.Simulator(self.builder.Build())
        context = self.plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        for ball, z in zip(self.balls, places):
            self.plant.SetFreeBodyPose(context, ball, pd.RigidTransform([0, 0, z]))
        before = pd.SpatialVelocity([0, 0, 0], [0, 0, -speed])
        self.plant.SetFreeBodySpatialVelocity(context=context, body=self.balls[0], V_JpJc=before)
        config = pd.SimulatorConfig(integration_scheme="runge_kutta3", accuracy=accuracy, max_step_size=self.longest, use_error_control=True)
        pd.ApplySimulatorConfig(config, simulator)
        began = time.process_time()
        simulator.AdvanceTo(end)
        seconds = time.process_time() - began
        z = [ball.EvalPoseInWorld(context).translation()[2] for ball in self.balls]
        v = [ball.EvalSpatialVelocityInWorld(context).translational()[2] for ball in self.balls]
        return z, v, seconds


def bounce(accuracy):
    world = World(*exported("drake", "bounce"), GRAVITY)
    world.add_ball("A", STRIKER)
    world.add_ground()
    (z,), (v,), seconds = world.simulate([RADIUS + DROP], 0.0, END, accuracy)
    return np.array([(z - RADIUS + 0.5 * v**2 / GRAVITY) / height_left()]), seconds


def run(scene, accuracy):
    if scene == "row":
        raise NotImplementedError("its contacts are fitted pair by pair")
    if scene == "bounce":
        return bounce(accuracy)
    told, text = exported("drake", scene)
    world = World(told, text, 0.0)
    world.add_ball("A", STRIKER)
    world.add_ball("B", STRIKER if scene == "balls" else BAR)
    end = GAP / SPEED[scene] + 2.0 * told["duration"]
    _, v, seconds = world.simulate([2.0 * RADIUS + GAP, 0.0], SPEED[scene], end, accuracy)
    return np.array([(v[0] - v[1]) / SPEED[scene]]), seconds
