"""Shapes that are made of unit cubes, in code."""

import itertools

import numpy as np

BAR = list(itertools.product(range(12), range(3), range(3)))
CACTUS = sorted({(0, y, z) for y in range(2) for z in range(12)}
                | {(x, 0, 4) for x in range(5)} | {(4, 0, z) for z in range(4, 9)}
                | {(-x, 1, 7) for x in range(4)} | {(-3, 1, z) for z in range(7, 11)})


def quads(cubes):
    """The boundary, oriented outwards, as quadrilaterals."""
    solid, numbers, faces = set(cubes), {}, []
    for cube in cubes:
        for axis, side in itertools.product(range(3), (0, 1)):
            neighbor = list(cube)
            neighbor[axis] += 2 * side - 1
            if tuple(neighbor) in solid:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            face = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))[::2 * side - 1]:
                corner = list(cube)
                corner[axis] += side
                corner[u] += a
                corner[v] += b
                face.append(numbers.setdefault(tuple(corner), len(numbers)))
            faces.append(face)
    return np.array(list(numbers), dtype=float), np.array(faces)


def triangles(cubes):
    vertices, faces = quads(cubes)
    return vertices, np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def tetrahedra(cubes):
    """Each cube in the six tetrahedra of Kuhn."""
    numbers, result = {}, []
    for cube in cubes:
        for axes in itertools.permutations(range(3)):
            corner, corners = np.array(cube), []
            for axis in (None, *axes):
                if axis is not None:
                    corner = corner + np.eye(3, dtype=int)[axis]
                corners.append(numbers.setdefault(tuple(int(c) for c in corner), len(numbers)))
            result.append(corners)
    return np.array(list(numbers), dtype=float), np.array(result)


def motion(axis, degrees, center=(0, 0, 0), shift=(0, 0, 0)):
    """The matrix of a rotation about an axis through a center, and a translation."""
    k = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    angle = np.radians(degrees)
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    matrix[:3, 3] = np.array(shift) + center - matrix[:3, :3] @ center
    return matrix


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]
