# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of a reduced body: its surface with places named on it, and a mode of vibration.

usage: picture.py BODY.h5 PICTURE.png [MODE [NAME=X,Y,Z ...]]    (mode from 1 on; the mesh's frame and unit)
Needs h5py and matplotlib.
"""

import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


def draw(axes, points, faces, colours, title):
    """Faces with their corners, coloured one by one."""
    axes.add_collection3d(Poly3DCollection(points[faces], facecolors=colours, edgecolors="#40404060", linewidths=0.2))
    low, high = points.min(axis=0), points.max(axis=0)
    for limit, bounds in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), zip(low, high)):
        limit(*bounds)
    axes.set_box_aspect(high - low)
    axes.set_axis_off()
    axes.view_init(elev=24, azim=-58)
    axes.set_title(title)


def main(body, picture, mode=1, *sites):
    with h5py.File(body) as file:
        unit, centre = file["unit"][()], file["centre"][()]
        points = (file["surface/points"][()] + centre) / unit
        shape = file["surface/shapes"][:, :, int(mode) - 1]
        hertz = file["modes/omega"][int(mode) - 1] / (2 * np.pi)
        counts, nodes = file["faces/count"][()], file["faces/nodes"][()]
    corners = 3 if counts[0] == 6 else 4
    faces = nodes[:, :corners].astype(int)
    moved = np.linalg.norm(shape, axis=1)

    figure = plt.figure(figsize=(10, 5))
    axes = figure.add_subplot(1, 2, 1, projection="3d")
    draw(axes, points, faces, "#c9d6e6", "the part and its sites")
    for site in sites:
        name, place = site.split("=")
        x, y, z = (float(number) for number in place.split(","))
        axes.plot([x], [y], [z], "o", color="#c8501e", zorder=10)
        axes.text(x, y, z, "  " + name, color="#c8501e", zorder=11)

    size = 0.12 * np.ptp(points, axis=0).max() / moved.max()
    colours = plt.cm.viridis(moved[faces].mean(axis=1) / moved.max())
    axes = figure.add_subplot(1, 2, 2, projection="3d")
    draw(axes, points + size * shape, faces, colours, f"mode {mode}, {hertz:.0f} Hz")
    figure.savefig(picture, dpi=100, bbox_inches="tight")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
