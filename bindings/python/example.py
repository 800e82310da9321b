"""Bends and twists a bar, and draws it colored by the error of its edges.

usage: example.py [PICTURE.png]
"""

import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

import arap_deformation as arap  # noqa: E402


def bar(length=40, width=8):
    """A closed surface of squares of unit size, whose axis is x."""
    numbers, faces = {}, []
    sizes = np.array([length, width, width])
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side, order in ((0, (0, 3, 2, 1)), (sizes[axis], (0, 1, 2, 3))):
            for a in range(sizes[u]):
                for b in range(sizes[v]):
                    corners = np.zeros((4, 3), dtype=int)
                    corners[:, axis] = side
                    corners[:, u] = a + np.array([0, 1, 1, 0])
                    corners[:, v] = b + np.array([0, 0, 1, 1])
                    faces.append([numbers.setdefault(tuple(corners[k]), len(numbers))
                                  for k in order])
    return np.array(list(numbers), dtype=float) - [0, width / 2, width / 2], np.array(faces)


def turn(axis, degrees, center):
    """The matrix of a rotation about a coordinate axis through a point."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(4)
    matrix[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    matrix[:3, 3] = center - matrix[:3, :3] @ center
    return matrix


def bend(degrees, start, end):
    """Moves what is beyond so that what is between two planes of x can be an arc of its length."""
    radius = (end - start) / np.radians(degrees)
    matrix = turn(1, -degrees, np.array([start, 0, radius]))
    matrix[:3, 3] -= matrix[:3, 0] * (end - start)
    return matrix


vertices, faces = bar()
fixed = np.flatnonzero(vertices[:, 0] <= 2)
handle = np.flatnonzero(vertices[:, 0] >= 38)

session = arap.Deformation(vertices, faces)
session.insert_handles(fixed)
session.insert_handles(handle)
results = [("rest shape", vertices, np.zeros(len(vertices)))]
for name, matrix in (("bent by 120 degrees", bend(120, 2, 38)),
                     ("twisted by 135 degrees", turn(0, 135, np.zeros(3)))):
    session.transform(handle, matrix, from_rest=True)
    report = session.deform()
    print(f"{name}: {report.iterations} iterations, energy {session.energy:.4g}, edge error "
          f"{session.quality().edge_length_error:.4f}, {1000 * report.seconds['total']:.0f} ms")
    error = session.quality_at_vertices("edge_length_error")
    results.append((name, session.vertices.copy(), error))

figure = plt.figure(figsize=(12, 4.5))
largest = max(error.max() for _, _, error in results)
held = np.isin(faces, fixed).all(axis=1), np.isin(faces, handle).all(axis=1)
for k, (name, points, error) in enumerate(results):
    axes = figure.add_subplot(1, 3, k + 1, projection="3d")
    at_faces = error[faces].mean(axis=1)
    corners = points[faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    colors = plt.cm.Blues(0.25 + 0.7 * at_faces / largest)
    colors[held[0]] = matplotlib.colors.to_rgba("firebrick")
    colors[held[1]] = matplotlib.colors.to_rgba("gold")
    colors[:, :3] *= (0.6 + 0.4 * np.clip(normals @ [0.3, -0.6, 0.74], 0, 1))[:, None]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colors, linewidths=0.3,
                                           edgecolors=(0, 0, 0, 0.25)))
    low, high = points.min(axis=0), points.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=name)
    axes.set_box_aspect(high - low)
    axes.view_init(20, -70)
    axes.set_axis_off()
scale = figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(0, largest), "Blues"), ax=figure.axes,
                        shrink=0.7, pad=0.02)
scale.set_label("relative error of the edges")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "example.png", dpi=110, bbox_inches="tight")
