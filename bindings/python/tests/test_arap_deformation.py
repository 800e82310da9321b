"""The Python module: identities, the command's energies, and bad input."""

import copy
import gc
import itertools
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import arap_deformation as arap
from shapes import BAR, CACTUS, motion, moved, quads, tetrahedra, triangles

ROOT = Path(__file__).resolve().parents[3]
TURN = motion((1, 2, 3), 50, (1, 0, 2), (3, -1, 2))
SHAPES = {"bar": triangles(BAR), "cactus": triangles(CACTUS), "quads": quads(CACTUS),
          "solid": tetrahedra(BAR)}


def ends(vertices):
    axis = np.argmax(np.ptp(vertices, axis=0))
    x = vertices[:, axis]
    return np.flatnonzero(x == x.min()), np.flatnonzero(x == x.max())


def bent(name="bar", matrix=motion((1, 1, 0), 70), **options):
    """A session whose ends are handles, one of which is moved."""
    vertices, simplices = SHAPES[name]
    d = arap.Deformation(vertices, simplices, tetrahedra=name == "solid", **options)
    fixed, moving = ends(vertices)
    d.insert_handles(fixed)
    d.insert_handles(moving)
    d.transform(moving, matrix)
    return d


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("cells", ["spokes", "k_ring:1", "spokes_and_rims", "elements"])
def test_rigid_motions_cost_nothing(name, cells):
    vertices, simplices = SHAPES[name]
    held = np.concatenate(ends(vertices))
    targets = moved(TURN, vertices[held])
    options = {"cells": cells, "tetrahedra": name == "solid"}
    expected = moved(TURN, vertices)
    for result in (arap.deform(vertices, simplices, [], (held, targets), **options),
                   arap.deform(vertices, simplices, [], dict(zip(held, targets)), **options)):
        assert np.abs(result - expected).max() < 1e-6
    d = arap.Deformation(vertices, simplices, **options)
    d.insert_handles(held)
    d.transform(held, TURN, from_rest=True)
    assert np.array_equal(d.target(held[3]), moved(TURN, vertices[held[3]]))
    assert d.deform()
    assert d.energy < 1e-9
    free = ~np.isin(np.arange(len(vertices)), held)  # else a cell need not be in the region
    if cells == "elements":
        free = free[simplices].any(axis=1)
    assert np.abs(d.rotations() - TURN[:3, :3])[free].max() < 1e-6
    assert d.quality().edge_length_error < 1e-6
    assert d.quality_at_vertices("angle_change").max() < 1e-4


def test_a_bend_and_its_report():
    d = bent()
    report = d.deform()
    assert report.status == "converged" and report.stages["factor"] and report.message
    assert report.initial_guess == "rotations"
    assert len(report.energy) == report.iterations + 1 and report.seconds["total"] > 0
    assert (np.diff(report.energy) <= 0).all() and report.energy[-1] == d.energy > 0
    fixed, moving = ends(d.rest_vertices)
    vertices = arap.deform(*SHAPES["bar"], fixed, (moving, d.vertices[moving]))
    assert np.array_equal(vertices, d.vertices) and vertices.flags.writeable
    assert np.array_equal(d.vertices[fixed], d.rest_vertices[fixed])
    assert d.quality().largest_angle_change == d.quality_at_vertices("angle_change").max() > 1


def test_positions_that_are_set():
    d = bent()
    d.deform()
    other = bent()
    view = other.vertices
    start, targets = other.vertices.copy(), [other.target(h) for h in other.handles]
    other.vertices = d.vertices
    assert np.array_equal(other.vertices, d.vertices)
    assert np.array_equal([other.target(h) for h in other.handles], targets)
    assert np.array_equal(other.rest_vertices, d.rest_vertices)
    report = other.deform(0, 0)
    assert report.energy[0] == pytest.approx(d.energy, rel=1e-9)
    other.vertices = start
    assert np.array_equal(other.vertices, start)
    for wrong, error, match in ((start[1:], ValueError, "vertices, but"),
                                (start * np.nan, arap.DeformationError, "vertex 0 is not finite"),
                                (start[:, :2], ValueError, "must have the shape")):
        with pytest.raises(error, match=match):
            other.vertices = wrong
    assert np.array_equal(other.vertices, start)
    assert np.array_equal(view, start)  # the same memory

    state = other.state()
    other.region = np.flatnonzero(start[:, 0] >= 6)
    moved_too = start + [0, 0, 0.5] * (start[:, :1] < 3)
    other.vertices = moved_too
    assert other.deform()
    assert np.array_equal(other.vertices[start[:, 0] < 6], moved_too[start[:, 0] < 6])
    other.restore(state)
    assert np.array_equal(other.vertices, start)

    broken = start.copy()
    broken[7] = np.nan
    mended = arap.Deformation(broken, SHAPES["bar"][1])
    mended.vertices = start
    mended.insert_handles(7)
    mended.transform(7, TURN, from_rest=True)
    assert np.array_equal(mended.target(7), moved(TURN, start[7]))
    for points in (start + 1, start):  # it is mended when it is used
        mended.vertices = points
        expected = start.copy()
        expected[7] = points[7]
        assert np.array_equal(mended.rest_vertices, expected)
    assert mended.deform()
    mended.vertices = start + 1
    assert np.array_equal(mended.rest_vertices, start)


def test_one_handle_alone():
    d = arap.Deformation(*SHAPES["bar"])
    d.insert_handles(3)
    d.set_targets(3, [1, 2, 3])
    assert np.array_equal(d.target(3), [1, 2, 3])
    d.set_velocities(5, [0, 0, 1])
    assert np.array_equal(d.velocities()[5], [0, 0, 1])


def test_the_energy_is_that_of_its_formula():
    d = bent("cactus")
    d.deform(7, 0)
    energy, r, p = 0, d.rotations(), d.vertices
    for t in SHAPES["cactus"][1]:
        for a in range(3):
            i, j, k = np.roll(t, a)
            u, v = d.rest_vertices[i] - d.rest_vertices[k], d.rest_vertices[j] - d.rest_vertices[k]
            weight = u @ v / np.linalg.norm(np.cross(u, v)) / 2
            for c in t:
                energy += weight * np.sum((p[i] - p[j] - r[c] @ (u - v))**2)
    assert energy == pytest.approx(d.energy, rel=1e-11)


@pytest.mark.skipif("ARAP_DEFORM" not in os.environ, reason="ARAP_DEFORM does not name the command")
@pytest.mark.parametrize("cells", ["spokes", "spokes_and_rims", "elements"])
@pytest.mark.parametrize("minimizer", ["local_global", "quasi_newton"])
@pytest.mark.parametrize("name", ["bar", "cactus"])
def test_energies_are_those_of_the_command(name, cells, minimizer, tmp_path):
    vertices, faces = SHAPES[name]
    fixed, moving = ends(vertices)
    kinds = np.ones(len(vertices), dtype=int)
    kinds[fixed], kinds[moving] = 0, 2
    matrix = motion((1, 1, 0), 70)
    np.savetxt(tmp_path / "s.sel", kinds, "%d")
    np.savetxt(tmp_path / "t.def", matrix, "%.17g")
    with open(tmp_path / "m.off", "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        np.savetxt(file, vertices, "%.17g")
        np.savetxt(file, np.c_[np.full(len(faces), 3), faces], "%d")
    subprocess.run([os.environ["ARAP_DEFORM"], "m.off", "--selection", "s.sel", "--transform",
                    "t.def", "-o", "out.off", "--report", "r.json", "--cells", cells, "--minimizer",
                    minimizer, "--iterations", "20", "--tolerance", "0", "--quiet"],
                   cwd=tmp_path, check=True)
    expected = json.loads((tmp_path / "r.json").read_text())
    d = bent(name, matrix, cells=cells, minimizer=minimizer)
    report = d.deform(20, 0)
    assert report.status == expected["status"]
    assert report.energy == pytest.approx(expected["energy"], rel=1e-9)
    assert d.quality().edge_length_error == pytest.approx(expected["edge_length_error"], rel=1e-9)


def test_the_same_bits():
    results = []
    for threads in (0, 1, 2, 2):
        d = bent("solid", threads=threads)
        d.deform(30, 0)
        results.append(d.vertices.tobytes())
    assert len(set(results)) == 1


@pytest.mark.parametrize("change", [
    np.asfortranarray, lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a[::-1].copy()[::-1],
    lambda a: np.c_[a, a][:, :a.shape[1]], lambda a: a.tolist(),
    lambda a: a.astype(np.float32 if a.dtype.kind == "f" else np.uint16),
    lambda a: a.astype(">f8" if a.dtype.kind == "f" else ">i8")])
def test_arrays_of_any_order_and_type(change):
    vertices, faces = SHAPES["bar"]
    fixed, moving = ends(vertices)
    targets = vertices[moving] + [0, 2, 0]
    expected = arap.deform(vertices, faces, fixed, (moving, targets))
    result = arap.deform(change(vertices), change(faces), list(fixed), (moving, change(targets)))
    assert np.array_equal(result, expected)


def test_input_is_copied():
    vertices, faces = (a.copy() for a in SHAPES["bar"])
    d, expected = arap.Deformation(vertices, faces), bent()
    fixed, moving = ends(vertices)
    matrix, forces, same = motion((1, 1, 0), 70), np.ones_like(vertices), np.ones_like(vertices)
    d.insert_handles(fixed)
    d.insert_handles(moving)
    d.transform(moving, matrix)

    def overwrite(*_):
        for array in (vertices, faces, matrix, forces, moving):
            array[:] = 99

    for session, push, visitor in ((d, forces, overwrite), (expected, same, None)):
        session.advance(forces=push, visitor=visitor)
        session.deform(5, 0, visitor=visitor)
    assert np.array_equal(d.vertices, expected.vertices)


def test_views():
    d = bent()
    view, before = d.vertices, d.vertices.copy()
    assert not view.flags.writeable and not view.flags.owndata
    with pytest.raises(ValueError):
        view[0] = 1
    with pytest.raises(ValueError):
        view.setflags(write=True)
    d.deform()
    assert np.array_equal(view, d.vertices) and not np.array_equal(view, before)
    after = view.copy()
    del d
    gc.collect()
    others = [np.full(len(after) * 3, 7.0) for _ in range(100)]  # would take its memory
    assert np.array_equal(view, after) and len(others) == 100


def test_options():
    d = arap.Deformation(*SHAPES["bar"], cells="k_ring:2", iterations=7, tolerance=np.float32(0.5))
    assert (d.cells, d.iterations, d.tolerance) == ("k_ring:2", 7, 0.5)
    assert (d.minimizer, d.initial_guess, d.threads) == ("automatic", "automatic", 0)
    assert d.verify_minimum is True
    d.verify_minimum = False
    assert d.verify_minimum is False
    assert d.coarse_metric is True
    d.coarse_metric = False
    assert d.coarse_metric is False
    d.tolerance = 1 / 3
    d.bending_length = d.smoothing_length = 2
    assert d.tolerance == 1 / 3 and d.bending_length == d.smoothing_length == 2
    with pytest.raises(arap.DeformationError, match="bending_length needs cells at vertices"):
        d.cells = "elements"
    assert d.cells == "k_ring:2"
    with pytest.raises(AttributeError):
        d.itarations = 5
    # several are valid or not together, and set or not together
    both = arap.Deformation(*SHAPES["bar"], bending_length=1, cells="spokes")
    assert (both.cells, both.bending_length) == ("spokes", 1)
    with pytest.raises(arap.DeformationError, match="'colour' is not known"):
        arap.Deformation(*SHAPES["bar"], colour=1)


def test_values_are_compared_and_copied():
    d = bent()
    report, place = d.deform(), d.locate((0, 0, 0))
    assert report == report and report != bent().deform() and place != d.locate((0, 0, 0))
    for function in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="cannot be copied or pickled"):
            function(d)


def test_states():
    d = bent()
    d.deform()
    state, vertices = d.state(), d.vertices.copy()
    d.make_rest_shape()
    assert np.array_equal(d.rest_vertices, vertices)
    d.reset()
    d.clear_handles()
    assert d.handles.size == 0
    d.restore(state)
    assert np.array_equal(d.vertices, vertices) and len(d.handles) == 32
    assert np.array_equal(d.rest_vertices, SHAPES["bar"][0])
    d.reset()
    assert np.array_equal(d.vertices, d.rest_vertices)
    other = bent()
    with pytest.raises(arap.DeformationError) as error:
        other.restore(state)
    assert error.value.status == "foreign_state" and str(error.value)
    with pytest.raises(arap.DeformationError) as error:
        arap.Deformation(*tetrahedra(BAR), tetrahedra=True).restore(d.state())
    assert error.value.status == "foreign_state" and "another kind of shape" in str(error.value)
    with pytest.raises(TypeError, match="what state.. returns"):
        d.restore("state")


def test_region_weights_points_and_frames():
    d = bent()
    d.region = np.flatnonzero(d.rest_vertices[:, 0] >= 6)
    assert (d.region >= 0).all() and len(d.region) < len(d.vertices)
    d.deform()
    outside = d.rest_vertices[:, 0] < 6
    assert np.array_equal(d.vertices[outside], d.rest_vertices[outside])

    d = bent()
    d.erase_handles(ends(d.rest_vertices)[1])
    place = d.locate([6.2, 3.5, 1.3])
    assert place.distance == pytest.approx(0.5) and place.coordinates.sum() == pytest.approx(1)
    handle = d.insert_point(place.simplex, place.coordinates)
    assert handle == len(d.vertices) == d.handles[-1]
    d.set_targets({handle: [6, 5, 1]})
    d.deform()
    assert d.point_position(handle) == pytest.approx([6, 5, 1])
    errors = []
    for weight in (1e-3, 1, 1e3):
        d.set_weight(handle, weight)
        report = d.deform(tolerance=1e-6)
        assert report.final_energy == report.energy[-1]
        errors.append(np.linalg.norm(d.point_position(handle) - [6, 5, 1]))
    assert errors[0] > errors[1] > errors[2] > 0

    d = arap.Deformation(*SHAPES["bar"])
    d.insert_handles(0)
    d.set_targets(0, moved(TURN, d.vertices[:1]))
    d.set_rotation(0, TURN[:3, :3])
    d.deform()
    assert np.abs(d.vertices - moved(TURN, d.rest_vertices)).max() < 1e-6


def test_polygons_of_different_numbers_of_corners():
    vertices, faces = SHAPES["quads"]
    mixed = [list(f) for f in faces[40:]]
    for f in faces[:40]:
        mixed += [f[[0, 1, 2]].tolist(), f[[0, 2, 3]].tolist()]
    rows = np.full((len(mixed), 5), -1)
    for row, face in zip(rows, mixed):
        row[:len(face)] = face
    fixed, moving = ends(vertices)
    targets = vertices[moving] + [3, 2, -1]
    results = [arap.deform(vertices, m, fixed, (moving, targets)) for m in (mixed, rows)]
    assert np.array_equal(*results)
    assert not np.array_equal(results[0], arap.deform(vertices, faces, fixed, (moving, targets)))
    d = arap.Deformation(vertices, mixed, cells="elements")
    points = [vertices[f].mean(axis=0) for f in mixed]
    places = d.locate_all([*points, np.full(3, np.nan)])
    assert places.pop() is None and d.locate_all([]) == []
    for point, place in zip(points, places):
        assert len(place.coordinates) == len(mixed[place.simplex])
        assert place.coordinates @ vertices[mixed[place.simplex]] == pytest.approx(point)
    assert d.point_position(d.insert_points(places)) == pytest.approx(np.array(points))
    assert len(d.insert_points([])) == 0
    assert (d.rotations() == np.eye(3)).all() and len(d.rotations()) == len(mixed)
    with pytest.raises(IndexError, match="-1 before other corners"):
        arap.Deformation(vertices, [[0, -1, 2]])
    with pytest.raises(IndexError, match="number -1"):
        arap.Deformation(vertices, [[0, 1, 2, -1]], tetrahedra=True)
    with pytest.raises(ValueError, match="simplices must be an array of integers"):
        arap.Deformation(vertices, [[0, 1, 2, 3], [0, 1, 2]], tetrahedra=True)


def test_targets_that_are_sets():
    vertices, faces = SHAPES["bar"]
    d = arap.Deformation(vertices, faces)
    every = np.arange(len(vertices))
    d.insert_handles(every)
    d.set_weight(every, 1)
    surface = moved(motion((1, 2, 3), 4, (5, 1, 1), (0.2, -0.1, 0.1)), vertices)
    d.set_target_surface(every, surface, faces.tolist())
    for _ in range(20):  # as a registration: a surface has corners, where targets jump
        report = d.deform(tolerance=1e-6)
    other = arap.Deformation(surface, faces)
    distances = [place.distance for place in other.locate_all(d.vertices)]
    assert max(distances) < 1e-3 and report.energy[-1] < 1e-5
    assert np.abs(d.vertices - surface).max() < 1e-2
    state = d.state()

    d = arap.Deformation(vertices, faces)
    fixed, moving = ends(vertices)
    d.insert_handles(fixed)
    d.insert_handles(moving)
    d.set_weight(moving, 1e4)
    d.set_target_plane(moving, [0, 0, 5], [0, -1, 2])
    d.deform()
    assert np.abs((d.vertices[moving] - [0, 0, 5]) @ [0, -1, 2]).max() < 1e-2
    d.set_target_line(moving, [0, 4, 4], [3, 0, 0])
    d.deform()
    assert np.abs(d.vertices[moving, 1:] - 4).max() < 0.05
    assert d.target(moving[0]) == pytest.approx([d.vertices[moving[0], 0], 4, 4])
    d.set_weight([fixed[0], moving[0]], 7)
    d.deform()
    energy = d.energy
    with pytest.raises(arap.DeformationError, match="needs a finite weight"):  # and changes nothing
        d.set_weight([fixed[0], moving[0]], np.inf)
    assert d.weight(fixed[0]) == 7 and d.weight(moving[0]) == 7 and d.energy == energy
    d.set_weight(moving[1:], 3)
    with pytest.raises(arap.DeformationError, match="of another object"):
        d.restore(state)


def test_a_surface_that_follows_tetrahedra():
    d = bent("solid")
    inside = np.random.default_rng(2).uniform(V.min(axis=0) - 0.2, V.max(axis=0) + 0.2, (50, 3))
    places = d.locate_all(inside)
    assert d.positions(places) == pytest.approx(inside, abs=1e-12)
    assert d.positions([]).shape == (0, 3)
    d.deform()
    corners = d.vertices[SHAPES["solid"][1][[place.simplex for place in places]]]
    expected = np.einsum("kc,kcx->kx", [place.coordinates for place in places], corners)
    assert d.positions(places) == pytest.approx(expected, abs=1e-12)
    d.vertices = moved(TURN, d.rest_vertices)
    assert d.positions(places) == pytest.approx(moved(TURN, inside), abs=1e-12)
    for short in ([arap.Place(7, np.array([0, 0, 1]), 0)] * 2, [places[0], arap.Place(7, [0, 0, 1], 0)]):
        with pytest.raises(ValueError, match="place . has 3 coordinates, but simplex 7 has 4 corn"):
            d.positions(short)
    with pytest.raises(ValueError, match="place 1 is None: the point was not located"):
        d.insert_points(d.locate_all([inside[0], np.full(3, np.nan)]))
    with pytest.raises(TypeError, match=r"place 0 is of type ndarray: locate\(\) returns places"):
        d.insert_points(inside)


@pytest.mark.parametrize("simplex, coordinates, error, match", [
    (7, [1, 1, 1], arap.DeformationError, "place 2 needs barycentric coordinates that are finite"),
    (7, [np.inf, 0, 1], arap.DeformationError, "place 2 needs barycentric"),
    (7, [1, -np.inf, 0], arap.DeformationError, "place 2 needs barycentric"),
    (7, [1, 0, 0, np.nan], arap.DeformationError, "place 2 has a coordinate that is not a number"),
    (7, [0.5, 0.5, np.nan], arap.DeformationError, "place 2 has a coordinate that is not a num"),
    (7, [0.5, 0.5], ValueError, "place 2 has 2 coordinates, but simplex 7 has 3 corners"),
    (7, [], ValueError, "place 2 has 0 coordinates"),
    (len(SHAPES["bar"][1]), [1, 0, 0], arap.DeformationError, "place 2: .* does not exist"),
    (10**6, [1, 0, 0], IndexError, "place 2: there is no simplex 1000000")])
def test_wrong_places_are_named_and_use_up_no_handle(simplex, coordinates, error, match):
    vertices, faces = SHAPES["bar"]
    n = len(vertices)
    d = arap.Deformation(vertices, np.vstack([faces, [0, 1, n]]))
    good = arap.Place(0, np.full(3, 1 / 3), 0)
    wrong = arap.Place(simplex, np.array(coordinates), 0)
    for function in (d.positions, d.insert_points):
        with pytest.raises(error, match=match):
            function([good, good, wrong, good])
    with pytest.raises(error, match=match.replace("2", "0", 1)):
        d.insert_point(simplex, coordinates)
    assert d.handles.size == 0 and d.insert_point(0, good.coordinates) == n


def test_values_for_each_handle():
    d, other = bent(), bent()
    random = np.random.default_rng(1)
    points = V[F[::4][:80]].mean(axis=1) + random.normal(size=(80, 3)) * 0.1
    weights, normals = random.uniform(0.1, 10, size=80), random.normal(size=(80, 3))
    moving = ends(V)[1]
    rotations = np.array([motion((1, 1, 0), 60 + k)[:3, :3] for k in range(len(moving))])
    places = d.locate_all(points)
    handles = d.insert_points(places)
    d.set_weight(handles, weights)
    d.set_target_plane(handles[:60], points[:60], normals[:60])
    d.set_target_line(handles[60:], points[60:], [1, 2, 3])
    d.set_rotation(moving, rotations)
    for k, place in enumerate(places):
        handle = other.insert_point(place.simplex, place.coordinates)
        assert handle == handles[k]
        other.set_weight(handle, weights[k])
        if k < 60:
            other.set_target_plane(handle, points[k], normals[k])
        else:
            other.set_target_line(handle, points[k], [1, 2, 3])
    for vertex, rotation in zip(moving, rotations):
        other.set_rotation(vertex, rotation)
    for session in (d, other):
        session.deform(5, 0)
    assert np.array_equal(d.vertices, other.vertices)
    assert np.array_equal(d.weight(handles), weights) and other.weight(handles[7]) == weights[7]
    assert np.array_equal(d.target(handles), [other.target(handle) for handle in handles])
    assert np.array_equal(d.point_position(handles), [other.point_position(h) for h in handles])

    before, energy = d.handles, d.energy
    wrong = arap.Place(places[1].simplex, np.ones(3), 0)
    for call, error in ((lambda: d.insert_points([places[0], wrong]), arap.DeformationError),
                        (lambda: d.set_weight(handles[:2], [1, -1]), arap.DeformationError),
                        (lambda: d.set_weight(handles[:3], [1, 2]), ValueError),
                        (lambda: d.set_rotation(moving[:2], [np.eye(3), TURN[:3, :3] * 2]),
                         arap.DeformationError)):
        with pytest.raises(error):
            call()
        assert np.array_equal(d.handles, before) and d.energy == energy
        assert np.array_equal(d.weight(handles), weights)
    for session in (d, other):
        session.deform(5, 0)
    assert np.array_equal(d.vertices, other.vertices)
    d.clear_points()
    assert np.array_equal(d.handles, bent().handles)


def test_no_handles():
    d, expected = bent(), bent()
    handles = d.insert_points(d.locate_all([]))
    d.set_weight(handles, [])
    d.set_targets(handles, [])
    d.set_target_plane(handles, [], [])
    d.set_target_line(handles, [], [0, 0, 1])
    d.set_rotation([], [])
    for session in (d, expected):
        session.deform(3, 0)
    assert np.array_equal(d.vertices, expected.vertices)


def test_frames_at_all_vertices():
    d = arap.Deformation([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], smoothing_length=1)
    d.insert_handles([0, 1, 2])
    d.set_weight([0, 1, 2], 2)
    d.set_rotation([0, 1, 2], np.eye(3))
    d.set_targets({0: [0, 0, 1]})
    assert d.deform().status == "converged"
    d.advance()


def test_stiffness_and_groups():
    d, twice, rigid = bent(), bent(), bent()
    d.deform(5, 0)
    twice.set_stiffness(np.full(len(d.vertices), 2))
    twice.deform(5, 0)
    assert twice.energy == pytest.approx(2 * d.energy, rel=1e-9)
    rigid.set_groups(np.zeros(len(d.vertices), dtype=int))
    rigid.deform(5, 0)
    assert np.ptp(rigid.rotations(), axis=0).max() == 0 < np.ptp(d.rotations(), axis=0).max()


def test_values_of_cells_are_not_those_of_other_cells():
    d = bent()
    for set_values, cleared in ((d.set_stiffness, []), (d.set_groups, [])):
        set_values(np.ones(len(d.vertices), dtype=int))
        with pytest.raises(ValueError, match="cells: .* of each vertex, .*; clear it first"):
            d.cells = "elements"
        d.cells = "spokes"
        assert d.deform()
        set_values(cleared)
    d.cells = "elements"
    d.set_stiffness(np.ones(len(SHAPES["bar"][1])))
    with pytest.raises(ValueError, match="of each simplex"):
        d.cells = "spokes"
    assert d.deform()


def test_weights_are_told():
    d = bent()
    handle = d.handles[0]
    assert d.weight(handle) == np.inf
    d.set_weight(handle, 3)
    assert d.weight(handle) == 3


def test_preparation_tells_what_is_free():
    points, faces = SHAPES["bar"]
    n = len(points)
    d = arap.Deformation(np.vstack([points, points + 20]), np.vstack([faces, faces + n]))
    d.insert_handles([0, 1, 2])
    assert f"the unconstrained component of vertex {n}" in d.preprocess()


def test_a_handle_twice():
    d = bent()
    handle, *others = d.handles
    d.erase_handles([handle, handle])
    assert list(d.handles) == others
    with pytest.raises(ValueError, match="neither"):
        d.erase_handles([others[0], handle])
    assert list(d.handles) == others


def test_a_free_fall():
    d = arap.Deformation(*SHAPES["solid"], tetrahedra=True)
    g, h = np.array([0, 0, -10.0]), 0.01
    for k in range(1, 4):
        report = d.advance(h, density=2, modulus=100, acceleration=g)
        assert report.mass == pytest.approx(2 * len(BAR))
        assert report.momentum == pytest.approx(report.mass * k * h * g, abs=1e-9)
    lifted = d.vertices.copy()
    d.advance(h, density=2, modulus=100, forces=np.zeros_like(lifted))
    assert (d.vertices - lifted)[:, 2] == pytest.approx(3 * h * g[2] * h, rel=1e-6)


def test_velocities():
    d = arap.Deformation(*SHAPES["solid"], tetrahedra=True)
    every = np.arange(len(d.vertices))
    assert not d.velocities().any()
    thrown = np.tile([1.0, 2, -3], (len(every), 1))
    d.set_velocities(every, thrown)
    before = d.vertices.copy()
    d.advance(0.01, modulus=100)
    assert d.vertices - before == pytest.approx(0.01 * thrown, rel=1e-6)
    assert d.velocities() == pytest.approx(thrown, rel=1e-6)
    d.region = every[1:]
    assert not d.velocities()[0].any()
    kept = d.velocities()
    with pytest.raises(ValueError, match="vertex 0 is not in the region of interest"):
        d.set_velocities([1, 0], thrown[:2])
    with pytest.raises(ValueError, match="there are 2 vertices, but 1 velocities"):
        d.set_velocities([1, 2], thrown[:1])
    assert (d.velocities() == kept).all()


def test_visitors():
    d = bent()
    before, seen = d.vertices.copy(), []
    report = d.deform(visitor=lambda k, energy, points: seen.append((k, energy, points(), points)))
    assert [e for _, e, *_ in seen] == list(report.energy)
    assert [k for k, *_ in seen] == list(range(report.iterations + 1))
    *_, last, ask_later = seen[-1]
    assert np.array_equal(last, d.vertices) and last.flags.owndata
    assert not np.array_equal(seen[0][2], before) and not np.array_equal(seen[0][2], last)
    with pytest.raises(ValueError, match="the visitor has returned"):
        ask_later()
    d = bent()
    assert not d.deform(visitor=lambda k, *_: "cancel" if k == 3 else None)

    def fails(k, *_):
        if k == 2:
            raise KeyError("from the visitor")
    for visitor, error, match in ((fails, KeyError, "from the visitor"), (3, TypeError, "callable"),
                                  (lambda *_: 3, ValueError, "'stop' or 'cancel', not 3"),
                                  (lambda *_: d.reset(), arap.DeformationError, "at work"),
                                  (lambda *_: d.energy, arap.DeformationError, "at work")):
        with pytest.raises(error, match=match):
            d.deform(visitor=visitor)
        assert np.array_equal(d.vertices, before)
    report = d.deform(visitor=lambda k, *_: "stop" if k == 3 else "proceed")
    assert report and report.status == "stopped" and report.iterations == 3


def wait_until_at_work(d):
    """Without a visitor, this happens only if the global lock is released."""
    for _ in range(20_000):
        try:
            d.energy
        except arap.DeformationError as error:
            assert error.status == "in_a_run" and "another thread" in str(error)
            return True
        time.sleep(0.001)
    return False


def test_two_threads_on_one_object():
    d, alone = bent(minimizer="local_global"), bent(minimizer="local_global")
    go_on, reports = threading.Event(), []
    thread = threading.Thread(daemon=True, target=lambda: reports.append(
        d.deform(20, 0, lambda k, *_: None if k < 10 or go_on.wait() else None)))
    thread.start()
    try:
        assert wait_until_at_work(d)
        for call in (d.deform, d.reset, d.state, d.quality, d.rotations, d.preprocess):
            with pytest.raises(arap.DeformationError, match="another thread"):
                call()
        assert np.array_equal(d.vertices, SHAPES["bar"][0])
    finally:
        go_on.set()
        thread.join()
    alone.deform(20, 0)
    assert reports[0].iterations == 20 and np.array_equal(d.vertices, alone.vertices)


def test_python_ends_while_a_daemon_thread_works():
    script = """
import threading, numpy, arap_deformation as arap
points = numpy.array([(x, y, x * y / 500) for x in range(100) for y in range(100)], float)
square = numpy.array([(x * 100 + y, x * 100 + y + 100, x * 100 + y + 101, x * 100 + y + 1)
                      for x in range(99) for y in range(99)])
d = arap.Deformation(points, square, minimizer="local_global")
d.insert_handles([0, 99, 9999])
d.set_targets([9999], [[50, 50, 90]])
begun = threading.Event()
def work(visitor):
    while True:
        d.deform(10**9, 0, visitor)
threading.Thread(target=work, args=(%s,), daemon=True).start()
begun.wait(%s)
print("the end")
"""
    for visitor, seconds in (("lambda *_: begun.set()", 60), ("None", 0.3)):
        run = subprocess.run([sys.executable, "-c", script % (visitor, seconds)], timeout=120,
                             capture_output=True, text=True)
        assert (run.returncode, run.stdout) == (0, "the end\n"), run.stderr
        assert "terminate" not in run.stderr


def test_a_run_when_python_ends():
    script = """if True:
        import atexit
        def last():
            d = arap.Deformation([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
            d.insert_handles([0, 1])
            print(d.deform().status, end="")
        atexit.register(last)
        import arap_deformation as arap"""
    run = subprocess.run([sys.executable, "-c", script], timeout=120, capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (0, "converged"), run.stderr


def test_an_interruption_ends_a_run_and_the_global_lock_is_released():
    vertices, faces = quads([(x, y, 0) for x in range(60) for y in range(60)])
    d = arap.Deformation(vertices, faces, minimizer="local_global")
    d.insert_handles(np.concatenate(ends(vertices)))
    d.transform(ends(vertices)[1], motion((1, 0, 0), 170))
    thread = threading.Thread(
        daemon=True, target=lambda: wait_until_at_work(d) and os.kill(os.getpid(), signal.SIGINT))
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
    try:
        thread.start()
        with pytest.raises(KeyboardInterrupt):
            d.deform(2**31 - 1, 0)
            time.sleep(60)
    finally:
        signal.signal(signal.SIGINT, before)
    thread.join()
    assert np.array_equal(d.vertices, vertices)  # that run was not done
    assert d.deform(1)


V, F = SHAPES["bar"]
RAGGED = [[0, 0, 0], [1, 2]]
NAN, MANY = np.where(np.eye(len(V), 3), np.nan, V), np.full((1, 3), 2**31)
BAD_SHAPES = [
    ((V.astype(str), F), ValueError, "vertices must be numbers, not <U"),
    ((V.astype(complex), F), ValueError, "numbers, not complex128"),
    ((V.astype(object), F), ValueError, "numbers, not object"),
    ((V > 0, F), ValueError, "not bool"), ((None, F), ValueError, "numbers, not object"),
    ((V[:, :2], F), ValueError, r"shape \(any, 3\)"),
    ((V.ravel(), F), ValueError, "must have the shape"), ((V[None], F), ValueError, "shape"),
    ((RAGGED, F), ValueError, "vertices must be an array of numbers"),
    ((V, F.astype(float)), ValueError, "simplices must be integers, not float64"),
    ((V, F > 3), ValueError, "integers, not bool"),
    ((V, F[:, :2]), ValueError, "three corners, not 2"),
    ((V, F.ravel()), ValueError, "shape"), ((V, -F), IndexError, "-.*not from -1"),
    ((V, MANY), IndexError, "2147483648, which is not from -1"),
    ((V, [[0, 1, 2**70]]), ValueError, "object"),
]


@pytest.mark.parametrize("shape, error, match", BAD_SHAPES)
def test_bad_shapes(shape, error, match):
    with pytest.raises(error, match=match):
        arap.Deformation(*shape)


@pytest.mark.parametrize("shape, status", [
    ((NAN, F), "non_finite_point"), ((V * 1e200, F), "non_finite_weight"), ((V, []), "no_simplex"),
    ((V, F + 1), "not_a_simplex"), ((V, F * 0), "not_a_simplex")])
def test_bad_data(shape, status):
    with pytest.raises(arap.DeformationError) as error:
        arap.deform(*shape, [0, 1], {})
    assert error.value.status == status and len(str(error.value)) > 20


def test_an_empty_shape():
    assert arap.deform([], [], [], {}).shape == (0, 3)
    assert arap.deform([], [], [], ([], []), tetrahedra=True).shape == (0, 3)


CALLS = [
    (lambda d: d.insert_handles([-1]), IndexError, "number -1"),
    (lambda d: d.insert_handles(len(V)), IndexError, f"no vertex {len(V)}"),
    (lambda d: d.insert_handles(2**40), IndexError, "not from 0 to 2147483647"),
    (lambda d: d.insert_handles([0.5]), ValueError, "integers, not float64"),
    (lambda d: d.insert_handles(V[:, 0] == 0), ValueError, "flatnonzero"),
    (lambda d: d.insert_handles("all"), ValueError, "integers, not <U3"),
    (lambda d: d.insert_handles([[0], [1, 2]]), ValueError, "handles must be an array of integers"),
    (lambda d: d.target([[0], [1, 2]]), ValueError, "handle must be an array of integers"),
    (lambda d: setattr(d, "region", RAGGED), ValueError, "region must be an array of integers"),
    (lambda d: d.set_targets(0, RAGGED), ValueError, "targets must be an array of numbers"),
    (lambda d: d.set_weight([0, 1], RAGGED), ValueError, "weight must be an array of numbers"),
    (lambda d: d.set_rotation([0], RAGGED), ValueError, "rotation must be an array of numbers"),
    (lambda d: d.set_rotation(0, np.eye(2)), ValueError, r"the shape \(3, 3\), not \(2, 2\)"),
    (lambda d: d.set_target_plane(0, RAGGED, V[0]), ValueError, "point must be an array of numbers"),
    (lambda d: d.set_target_plane(0, [0, 0], V[0]), ValueError, r"the shape \(3,\), not \(2,\)"),
    (lambda d: d.set_targets(0, [0, 0]), ValueError, r"targets must have the shape \(3,\), not \(2,"),
    (lambda d: d.insert_point(0, 0.5), ValueError, r"coordinates must have the shape \(any,\), not \("),
    (lambda d: d.erase_handles(5000), ValueError, "handle 5000 is neither"),
    (lambda d: d.set_targets({100: [0, 0, 0]}), ValueError, "handle 100 is neither"),
    (lambda d: d.set_targets([0, 1], [[0, 0, 0]]), ValueError, "2 handles, but 1 targets"),
    (lambda d: d.set_targets([0], [[0, 0]]), ValueError, r"shape \(any, 3\), not \(1, 2\)"),
    (lambda d: d.set_targets({0: "here"}), ValueError, "targets must be numbers"),
    (lambda d: d.set_targets({"0": [1, 2, 3]}), ValueError, "integers, not <U1"),
    (lambda d: d.set_targets(7), ValueError, "a dict of points"),
    (lambda d: d.transform([0], np.eye(3)), ValueError, "shape"),
    (lambda d: d.transform([0], np.ones((4, 4))), ValueError, "last row"),
    (lambda d: d.transform([0], np.eye(4), "targets"), ValueError, "from_rest must be True or False"),
    (lambda d: d.set_weight([0], -1), arap.DeformationError, "weight"),
    (lambda d: d.set_weight([0], "big"), ValueError, "weight must be numbers"),
    (lambda d: d.set_rotation([0], np.ones((3, 3))), arap.DeformationError, "rotation"),
    (lambda d: d.set_rotation([0], np.ones(9)), ValueError, "shape"),
    (lambda d: d.set_rotation([70]), ValueError, "vertex 70 is not a control vertex"),
    (lambda d: d.locate([0, 0]), ValueError, "shape"),
    (lambda d: d.locate_all([0, 0, 0]), ValueError, "shape"),
    (lambda d: d.set_target_plane(0, [0, 0, 0], [0, 0, 1]), arap.DeformationError, "handle 0 has a"),
    (lambda d: d.set_target_plane([], [0, 0, 0], [0, 0, 0]), ValueError, "the normal must be"),
    (lambda d: d.set_target_line([], [0, 0, np.nan], [1, 0, 0]), ValueError, "the point must have"),
    (lambda d: d.set_target_line([], [0, 0], [1, 0, 0]), ValueError, "point must have the shape"),
    (lambda d: d.set_target_surface([], V, [[0, 1, len(V)]]), IndexError, "face 0 of the surface"),
    (lambda d: d.set_target_surface([], V, [[0, 1, 0]]), ValueError, "no face with an area"),
    (lambda d: d.set_target_surface([], NAN, F), ValueError, r"the vertex \d, which is not finite"),
    (lambda d: d.set_target_surface([], V, [[0, 1, 2], [3, 4]]), ValueError, "face 1 of the surface"),
    (lambda d: d.set_target_surface([], V, [[-1] * 3, [0, 1, 2]]), ValueError, "face 0 .* fewer than"),
    (lambda d: d.insert_point(10**6, [1, 0, 0]), IndexError, "no simplex 1000000"),
    (lambda d: d.insert_point(-1, [1, 0, 0]), IndexError, "number -1"),
    (lambda d: d.insert_point(0, [1, 1, 1]), arap.DeformationError, "coordinates"),
    (lambda d: d.insert_point(0.5, [1, 0, 0]), ValueError, "simplex must be integers"),
    (lambda d: d.point_position(3), ValueError, "not a control point"),
    (lambda d: d.target(77), ValueError, "neither"),
    (lambda d: d.target(2**31), IndexError, "not from"),
    (lambda d: d.set_stiffness([1, 2]), ValueError, "2 values for the"),
    (lambda d: d.set_groups([0.5]), ValueError, "integers"),
    (lambda d: d.set_groups(V[:, 0] == 0), ValueError, "groups must be integers, not bool$"),
    (lambda d: d.deform(-1), arap.DeformationError, "iterations '-1' is not a whole number"),
    (lambda d: d.deform(1, float("nan")), arap.DeformationError, "'nan' is not a number"),
    (lambda d: d.deform(1, "small"), arap.DeformationError, "tolerance 'small' is not a number"),
    (lambda d: d.advance(0), arap.DeformationError, "time_step"),
    (lambda d: d.advance("fast"), ValueError, "time_step must be numbers"),
    (lambda d: d.advance(True), ValueError, "time_step must be numbers, not bool$"),
    (lambda d: d.advance(acceleration=9.81), ValueError, "acceleration must have the shape"),
    (lambda d: d.advance(forces=V[:5]), ValueError, "three coordinates for each of the"),
    (lambda d: d.advance(forces=[]), ValueError, "three coordinates for each of the"),
    (lambda d: d.advance(forces=V * np.nan), arap.DeformationError, "force"),
    (lambda d: d.quality_at_vertices("beauty"), ValueError, "use one of edge_length_error"),
    (lambda d: setattr(d, "cells", "squares"), arap.DeformationError, "use one of spokes"),
    (lambda d: arap.Deformation(V, F, color=1), arap.DeformationError, "option 'color'"),
    (lambda d: arap.Deformation(V, F, weights="equal"), ValueError, "weights 'equal' is not known"),
    (lambda d: arap.Deformation(V, F, tetrahedra=True), ValueError, r"shape \(any, 4\)"),
    (lambda d: arap.Deformation(V, F, tetrahedra="no"), ValueError, "tetrahedra must be True or False"),
    (lambda d: arap.deform(V, F, [], {}), arap.DeformationError, "fix a vertex"),
    (lambda d: arap.deform(V, F, [0], {1: [0, 0, np.inf]}), arap.DeformationError, "vertex 1"),
    (lambda d: arap.deform(V, F, [0], [[1, 0, 0]]), ValueError, "a dict of points"),
]


@pytest.mark.parametrize("call, error, match", CALLS)
def test_bad_calls_change_nothing(call, error, match):
    d, expected = bent(), bent()
    with pytest.raises(error, match=match):
        call(d)
    for session in (d, expected):  # it serves as before
        session.deform(3, 0)
    assert np.array_equal(d.vertices, expected.vertices)


def test_the_code_of_the_readme():
    readme = (ROOT / "bindings/python/README.md").read_text()
    code = re.search("```python\n(.*?)```", readme, re.DOTALL).group(1)
    names = {}
    exec(code, names)
    assert 6 <= code.count("\n") <= 12 and not np.array_equal(names["V2"], names["V"])


def test_laplacian_guess_of_random_targets():
    """It is taken, although where it is solved to the last digits refining it fails."""
    vertices, faces = triangles(list(itertools.product(range(5), range(2), range(2))))
    handles = [3, 8, 11, 40, 48]
    for seed in range(100):
        guesses = []
        for guess in ("previous", "laplacian"):
            random = np.random.default_rng(seed)
            targets = vertices[handles] + random.normal(size=(5, 3)) * 0.3
            coordinates = random.dirichlet(np.ones(3))
            simplex = int(random.integers(len(faces)))
            shift = random.normal(size=3) * 0.3
            d = arap.Deformation(vertices, faces, initial_guess=guess)
            d.insert_handles(handles)
            d.set_targets(handles, targets)
            point = d.insert_point(simplex, coordinates)
            d.set_targets([point], [vertices[faces[simplex]].T @ coordinates + shift])
            assert d.deform(0, 0).initial_guess == guess
            guesses.append(d.vertices.copy())
        assert not np.array_equal(*guesses)
