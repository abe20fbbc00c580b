# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# %% [markdown]
# # A steel sphere on an aluminium beam: e is not a constant
#
# Needs a percussd with the shipped catalogue; PERCUSS_DOMAIN is its DDS domain. Run it cell by cell, or as
# a program: `python speed_sweep.py [FOLDER]` prints the tables and, where matplotlib is installed, writes
# its pictures into FOLDER.

# %%
import sys
from pathlib import Path

import numpy as np

import percuss

client = percuss.connect()
bodies = client.bodies()
sphere, beam = bodies["steel-sphere"], bodies["al-beam"]
print(f"{sphere.id}: {sphere.mass:.4f} kg, {sphere.description}")
print(f"{beam.id}: {beam.mass:.4f} kg, {beam.description}")

# %% [markdown]
# ## One impact
# The beam swings back and hits the sphere again, 5 ms after the first touch.

# %%
reply = client.solve(percuss.contact_pair(sphere, beam, speed=0.2)).raise_for_status()
contact = reply.contacts[0]
print(f"\nat 0.2 m/s: e = {contact.restitution:.4f}, {reply.end_reason.name}")
print("start/ms  length/us  impulse/N s  peak/N")
for one in contact.sub_impacts:
    length = 1e6 * (one["end"] - one["start"])
    print(f"{1e3 * one['start']:8.4f}  {length:9.2f}  {one['impulse']:11.7f}  {one['peak_force']:6.1f}")

# %% [markdown]
# ## Many speeds, in batches of one sample each
# Normally distributed around 0.25 m/s as in the measurements with 53 velocities; a fixed seed gives the
# same figures every time. Speeds below 0.05 m/s are left out.

# %%
speeds = np.random.default_rng(1).normal(0.25, 0.0929, 500)
speeds = np.sort(speeds[speeds > 0.05])
questions = [percuss.contact_pair(sphere, beam, speed) for speed in speeds]
replies = [
    answer.raise_for_status()
    for first in range(0, len(questions), percuss.MAX_BATCH)
    for answer in client.solve_batch(questions[first : first + percuss.MAX_BATCH], timeout=60.0)
]
client.close()
e = np.array([answer.contacts[0].restitution for answer in replies])
counts = np.array([np.count_nonzero(~answer.contacts[0].sub_impacts["negligible"]) for answer in replies])

# %% [markdown]
# ## Restitution against speed, and its distribution

# %%
bins = np.linspace(-0.05, 0.85, 19)
shares, _ = np.histogram(e, bins)
print(f"\n{len(e)} speeds, mean {speeds.mean():.3f}, deviation {speeds.std():.3f} m/s")
print(f"e: mean {e.mean():.3f}, deviation {e.std():.3f}, from {e.min():.3f} to {e.max():.3f}")
for low, share in zip(bins, shares):
    print(f"{low:6.2f} {'#' * int(share)}")

# %% [markdown]
# ## Sub-impacts

# %%
print("\nsub-impacts  speeds  mean e")
for count in np.unique(counts):
    chosen = counts == count
    print(f"{count:11}  {np.count_nonzero(chosen):6}  {e[chosen].mean():6.3f}")

# %% [markdown]
# ## The same as pictures

# %%
try:
    import matplotlib
except ImportError:
    print("\nno pictures: pip install matplotlib")
    sys.exit()
if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt

figure, (left, right, last) = plt.subplots(1, 3, figsize=(14, 4), layout="constrained")
left.scatter(speeds, e, c=counts, s=8, cmap="viridis")
left.set(xlabel="speed, m/s", ylabel="restitution", title="e against speed")
right.hist(e, bins)
right.set(xlabel="restitution", ylabel="speeds", title="distribution of e")
for speed, answer in zip(speeds, replies):
    parts = answer.contacts[0].sub_impacts
    areas = 1 + 15 * parts["impulse"] / parts["impulse"].max()
    last.scatter(np.full(len(parts), speed), 1e3 * parts["start"], s=areas, c="tab:red")
last.set(xlabel="speed, m/s", ylabel="start, ms", title="sub-impacts; area: impulse")
folder = Path(sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else ".")
figure.savefig(folder / "speed_sweep.png", dpi=120)
print(f"\n{folder / 'speed_sweep.png'}")
