"""As-rigid-as-possible deformation of surfaces and tetrahedral volumes.

``deform()`` is one call; ``Deformation`` is a session, for dragging, undo and time steps. n
vertices have coordinates of any unit of length, as an array of shape (n, 3); m faces or tetrahedra
have k corners, as an array of indices of shape (m, k); faces of fewer corners end with -1.
Arguments may be any arrays of numbers, or lists; they are copied. Energies are those of the manual:
with cotangent weights their unit is an area for surfaces and a volume for tetrahedra.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["deform", "Deformation", "DeformationError", "Place", "Quality", "Report", "State",
           "StepReport"]

Floats = NDArray[np.float64]
Visitor = Callable[[int, float, Callable[[], Floats]], Optional[str]]
Targets = Union[Mapping[int, ArrayLike], Tuple[ArrayLike, ArrayLike]]


class DeformationError(RuntimeError):
    """A call that failed by its data, and has changed nothing. ``status`` is the name of the
    outcome, such as ``"no_fixed_vertex"``, which the manual lists under ``CGAL::ARAP::Status``."""

    def __init__(self, message: str, status: str = "") -> None:
        super().__init__(message)
        self.status = status


from ._core import Session as _Session, State  # noqa: E402  (which raises DeformationError)


@dataclass(frozen=True, eq=False)  # arrays have no truth value
class Report:
    """What a call did. ``energy[k]`` is the energy after k iterations, ``seconds`` the time of each
    phase, ``stages`` what had to be prepared again; true if it was not cancelled."""

    status: str
    message: str
    initial_guess: str  # which was taken
    iterations: int
    energy: Floats = field(repr=False)
    energy_scale: float
    rounding_level: float
    estimated_relative_gap: float
    free_vertices: int
    simplices: int
    inverted_simplices: int
    end: str
    saddles_left: int
    plateaus_left: int
    looking_iterations: int
    unconstrained_components: List[int]
    stages: Dict[str, bool]
    seconds: Dict[str, float]

    @property
    def final_energy(self) -> float:
        """The energy of the last iterate; not a number if there was none."""
        return float(self.energy[-1]) if len(self.energy) else math.nan

    def __bool__(self) -> bool:
        return self.status != "cancelled"


@dataclass(frozen=True, eq=False)
class StepReport(Report):
    """A time step: also the mass, momenta and energies of the free vertices. ``energy``, which the
    step minimizes, has a term of inertia; ``elastic_energy`` has none: it is the modulus times
    ``Deformation.energy``."""

    mass: float
    center_of_mass: List[float]
    momentum: List[float]
    angular_momentum: List[float]
    kinetic_energy: float
    elastic_energy: float


@dataclass(frozen=True)
class Quality:
    """What was done to the whole shape: relative changes, and an angle in degrees. The volume is
    not a number for a surface that is not closed."""

    edge_length_error: float
    area_change: float
    volume_change: float
    largest_angle_change: float
    largest_spike: float
    inverted_simplices: int


@dataclass(frozen=True, eq=False)
class Place:
    """A place in a simplex: its number, barycentric coordinates, and the distance to it."""

    simplex: int
    coordinates: Floats
    distance: float


def _any_array(name: str, value: ArrayLike, what: str = "numbers") -> NDArray[Any]:
    """An array of any shape and type."""
    try:
        return np.asarray(value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} must be an array of {what}: {error}") from None


def _array(name: str, value: ArrayLike, kinds: str, shape: Sequence[Optional[int]]) -> NDArray[Any]:
    """A copy with the shape; None is any number. An empty list is an array of any dimension."""
    what = "numbers" if "f" in kinds else "True or False" if kinds == "b" else "integers"
    array = np.array(_any_array(name, value, what))
    if array.size == 0 and array.ndim == 1 and array.dtype.kind in "fiu":
        array = array.astype(np.int64).reshape([0] + [k or 3 for k in shape[1:]])
    if array.dtype.kind not in kinds:
        raise ValueError(f"{name} must be {what}, not {array.dtype}")
    if array.ndim != len(shape) or any(k not in (None, s) for k, s in zip(shape, array.shape)):
        wanted = str(tuple("any" if k is None else k for k in shape)).replace("'", "")
        raise ValueError(f"{name} must have the shape {wanted}, not {array.shape}")
    return array


def _floats(name: str, value: ArrayLike, *shape: Optional[int]) -> Floats:
    return np.ascontiguousarray(_array(name, value, "fiu", shape), dtype=np.float64)


def _float(name: str, value: float) -> float:
    return float(_array(name, value, "fiu", ()))


def _bool(name: str, value: bool) -> bool:
    return bool(_array(name, value, "b", ()))


def _integers(name: str, value: ArrayLike, *shape: Optional[int], least: int = 0) -> NDArray[Any]:
    array = _array(name, value, "iu", shape)
    if array.size and (array.min() < least or array.max() >= 2**31):
        wrong = array.min() if array.min() < least else array.max()
        raise IndexError(f"{name} has the number {wrong}, which is not from {least} to 2147483647")
    return np.asarray(array, dtype=np.int32, order="C")


def _indices(name: str, value: Any) -> NDArray[Any]:
    """Indices of vertices or handles, of which there may also be one alone."""
    array = np.atleast_1d(_any_array(name, value, "integers"))
    if array.dtype.kind == "b":
        raise ValueError(f"{name} must be integers, not bool; np.flatnonzero() makes indices of it")
    return _integers(name, array, None)


def _simplices(name: str, value: Any, corners: Optional[int] = None) -> NDArray[Any]:
    """Indices of corners; those of polygons may be lists of any lengths, or rows that end with -1."""
    is_list = isinstance(value, (list, tuple)) and corners is None
    if is_list and all(hasattr(row, "__len__") for row in value):
        if len({len(row) for row in value}) > 1:
            value = list(zip(*itertools.zip_longest(*value, fillvalue=-1)))
    array = _integers(name, value, None, corners, least=0 if corners else -1)
    if ((array[:, :-1] == -1) & (array[:, 1:] != -1)).any():
        raise IndexError(f"{name} has the number -1 before other corners")
    return array


def _pair(what: str, indices: Any, name: str, points: Any) -> Tuple[NDArray[Any], Floats]:
    """Indices with (k, 3) numbers, or one index with (3,)."""
    one = _any_array(what, indices, "integers").ndim == 0
    return _indices(what, indices), (_rows(name, points, 3) if one
                                     else _floats(name, points, None, 3))


def _rows(name: str, value: ArrayLike, *shape: int) -> Floats:
    """Values of the shape, one for all or one for each, as rows."""
    values = _any_array(name, value)
    each = () if values.ndim == len(shape) and values.size else (None,)
    return _floats(name, values, *each, *shape).reshape(-1, math.prod(shape))


def _targets(targets: Any) -> Tuple[NDArray[Any], Floats]:
    if isinstance(targets, Mapping):
        targets = (list(targets.keys()), list(targets.values()))
    elif not isinstance(targets, (tuple, list)) or len(targets) != 2:
        raise ValueError("targets must be a dict of points by handles, or a pair of both")
    return _pair("handles of targets", targets[0], "targets", targets[1])


def _places(places: Sequence[Optional[Place]]) -> Tuple[NDArray[Any], Floats]:
    """Simplices, and coordinates in rows of the same length, which NaN fills."""
    found: List[Place] = []
    for k, place in enumerate(places):
        if place is None:
            raise ValueError(f"place {k} is None: the point was not located")
        if not isinstance(place, Place):
            raise TypeError(f"place {k} is of type {type(place).__name__}: locate() returns places")
        found.append(place)
    given = _floats("coordinates", [x for place in found for x in place.coordinates], None)
    sizes = np.array([len(place.coordinates) for place in found], dtype=int)
    wrong = np.repeat(np.arange(len(found)), sizes)[np.isnan(given)]
    if wrong.size:
        raise DeformationError(f"place {wrong[0]} has a coordinate that is not a number",
                               "invalid_coordinates")
    rows = np.full((len(found), sizes.max(initial=0)), math.nan)
    rows[np.arange(rows.shape[1]) < sizes[:, None]] = given
    return _integers("simplex", [place.simplex for place in found], None), rows


def _text(value: Any) -> str:
    """An option as C++ reads it."""
    return str(value).lower() if isinstance(value, (bool, np.bool_)) else str(value)


def _option(name: str, kind: Callable[[str], Any], doc: str) -> Any:
    return property(lambda self: kind(self._session.option(name)),
                    lambda self, value: self._session.set_options({name: _text(value)}), doc=doc)


class Deformation:
    """A session: a shape, of which handles go to targets, and the rest follows as rigidly as
    possible. A handle is a number: that of a vertex, or from n on that of a point in a simplex.

    What takes long releases Python's global lock: the constructor, preprocess(), deform(),
    advance(), what searches or measures the whole shape. Until it is done, calls from other threads
    for the same object, and from its visitor, raise ``DeformationError`` with the status
    ``in_a_run``; only ``vertices`` can be had.
    """

    __slots__ = ("_session", "__weakref__")  # other names are likely misspelled options

    cells = _option("cells", str, "'spokes', 'spokes_and_rims', 'elements' or 'k_ring:K'")
    minimizer = _option("minimizer", str, "'automatic', 'local_global' or 'quasi_newton'")
    initial_guess = _option("initial_guess", str,
                            "'automatic', 'previous', 'rotations' or 'laplacian'")
    iterations = _option("iterations", int, "the maximum number of iterations of a run")
    tolerance = _option("tolerance", float, "the estimated relative gap that ends a run; 0: none, "
                        "and an automatic minimizer is local_global")
    verify_minimum = _option("verify_minimum", "true".__eq__, "whether saddle points are left")
    coarse_metric = _option("coarse_metric", "true".__eq__, "whether large shapes have one")
    threads = _option("threads", int, "the maximum number of threads; 0 for all")
    bending_length = _option("bending_length", float, "over which a bend is spread; 0 for none")
    smoothing_length = _option("smoothing_length", float, "of smooth rotations; 0 for none")

    def __init__(self, vertices: ArrayLike, simplices: ArrayLike, *, tetrahedra: bool = False,
                 weights: str = "safe_cotangent", **options: Any) -> None:
        """vertices: (n, 3), the rest shape; simplices: (m, k) faces of k corners, a list of faces of
        any numbers of corners, or (m, 4) tetrahedra; weights: 'safe_cotangent', 'cotangent',
        'clamped_cotangent' or 'uniform'; options: the properties of those names."""
        is_volume = _bool("tetrahedra", tetrahedra)
        self._session = _Session(_floats("vertices", vertices, None, 3),
                                 _simplices("simplices", simplices, 4 if is_volume else None),
                                 is_volume, str(weights))
        self._session.set_options({name: _text(value) for name, value in options.items()})

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError("a Deformation cannot be copied or pickled; construct another one from its "
                        "rest_vertices and set its vertices, or use state() and restore()")

    @staticmethod
    def _values(function: Callable[[NDArray[Any]], Floats], handles: ArrayLike, *shape: int) -> Any:
        """What the flat interface has for handles: of this shape for one, (k, ...) for k."""
        values = function(_indices("handle", handles)).reshape(-1, *shape)
        return values if np.ndim(handles) else values[0]

    @property
    def vertices(self) -> Floats:
        """(n, 3): where the vertices are, a view without a copy. It changes when a call succeeds,
        also one of another thread. Set it, and the next run starts from these positions; fixed
        vertices that are no handles stay there. The rest shape and the targets do not change."""
        return self._session.points()

    @vertices.setter
    def vertices(self, points: ArrayLike) -> None:
        self._session.set_points(_floats("vertices", points, None, 3))

    @property
    def rest_vertices(self) -> Floats:
        """(n, 3): a copy of the rest shape."""
        return self._session.rest_points().reshape(-1, 3)

    @property
    def region(self) -> NDArray[np.int32]:
        """The vertices that may move: the region of interest. At first it has all. Setting it erases
        handles at vertices outside of it; points stay."""
        return self._session.region()

    @region.setter
    def region(self, vertices: ArrayLike) -> None:
        self._session.set_region(_indices("region", vertices))

    @property
    def handles(self) -> NDArray[np.int32]:
        """The control vertices, then the control points."""
        return self._session.handles()

    def insert_handles(self, vertices: ArrayLike) -> None:
        """Makes control vertices, which stay where they are until they get other targets. They enter
        the region; those that are handles already keep their targets."""
        self._session.insert_handles(_indices("handles", vertices))

    def erase_handles(self, handles: ArrayLike) -> None:
        """Makes control vertices free, which stay in the region, and erases control points."""
        self._session.erase_handles(_indices("handles", handles))

    def clear_handles(self) -> None:
        """Erases all handles: control vertices and control points."""
        self._session.clear_handles()

    def clear_points(self) -> None:
        """Erases the handles that are control points."""
        self._session.clear_points()

    def locate(self, point: ArrayLike) -> Optional[Place]:
        """The place in a simplex that is nearest to a point (3,) where the shape is now. For a point
        outside of all tetrahedra the coordinates are those of the point itself: some are negative.
        None if there is no simplex, or if the point is not finite. Each call builds a search tree:
        for more than one point use ``locate_all()``."""
        return self.locate_all([_floats("point", point, 3)])[0]

    def locate_all(self, points: ArrayLike) -> List[Optional[Place]]:
        """The place of each point (k, 3), see ``locate()``, by one search tree."""
        places = self._session.locate(_floats("points", points, None, 3))
        return [None if place is None else Place(*place) for place in places]

    def insert_point(self, simplex: int, coordinates: ArrayLike) -> int:
        """The handle of a new control point with barycentric coordinates (k,) in a simplex.
        Messages number control points from 1: number k is the handle n + k - 1."""
        place = Place(simplex, _floats("coordinates", coordinates, None), 0)
        return int(self.insert_points([place])[0])

    def insert_points(self, places: Sequence[Optional[Place]]) -> NDArray[np.int32]:
        """The handles of new control points at places, as ``locate_all()`` returns them; all of them
        are inserted, or none. None, for a point that was not located, is refused."""
        return self._session.insert_points(*_places(places))

    def positions(self, places: Sequence[Optional[Place]]) -> Floats:
        """(k, 3): where places are now. What was located in the rest shape follows the shape, as a
        fine surface does that is located in tetrahedra."""
        return self._session.positions(*_places(places)).reshape(-1, 3)

    def point_position(self, handles: ArrayLike) -> Floats:
        """(3,): where a control point is, or (k, 3) of k control points."""
        return self._values(self._session.point_positions, handles, 3)

    def target(self, handles: ArrayLike) -> Floats:
        """(3,): the target of a handle, or of a target set the point nearest to the handle; (k, 3)
        of k handles."""
        return self._values(self._session.targets, handles, 3)

    def set_targets(self, handles: Union[ArrayLike, Targets],
                    points: Optional[ArrayLike] = None) -> None:
        """Sets the targets (k, 3) of k handles, the target (3,) of one handle, or all of a dict of
        points by handles."""
        self._session.set_targets(*_targets(handles if points is None else (handles, points)))

    def set_target_plane(self, handles: ArrayLike, point: ArrayLike, normal: ArrayLike) -> None:
        """Pulls handles, whose weights are finite, toward a plane, along which they can glide, or
        each toward its own: point and normal are (3,) or (k, 3). It is their target until they get
        another one, or are reset."""
        self._session.set_target_planes(_indices("handles", handles), _rows("point", point, 3),
                                        _rows("normal", normal, 3))

    def set_target_line(self, handles: ArrayLike, point: ArrayLike, direction: ArrayLike) -> None:
        """The same, toward a line."""
        self._session.set_target_lines(_indices("handles", handles), _rows("point", point, 3),
                                       _rows("direction", direction, 3))

    def set_target_surface(self, handles: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> None:
        """The same, toward the nearest points of a surface with vertices (k, 3) and faces of any
        numbers of corners, as a registration does. Each energy takes a search for each handle."""
        self._session.set_target_surface(_indices("handles", handles),
                                         _floats("vertices", vertices, None, 3),
                                         _simplices("faces", faces))

    def transform(self, handles: ArrayLike, matrix: ArrayLike, from_rest: bool = False) -> None:
        """Moves the targets of handles by a (4, 4) or (3, 4) matrix, or, with from_rest, to where it
        takes the points of the rest shape, which stays as it is. Targets of handles that are listed
        twice are moved twice."""
        self._session.transform(_indices("handles", handles), _floats("matrix", matrix, None, 4),
                                _bool("from_rest", from_rest))

    def weight(self, handles: ArrayLike) -> Any:
        """The weight of a target, or (k,) of k targets; infinite: hard."""
        return self._values(self._session.weights, handles)

    def set_weight(self, handles: ArrayLike, weight: ArrayLike = math.inf) -> None:
        """Makes targets soft, with a weight in the unit of the edge weights, one for all or (k,);
        infinite: hard."""
        self._session.set_weights(_indices("handles", handles), _rows("weight", weight))

    def set_rotation(self, vertices: ArrayLike, rotation: Optional[ArrayLike] = None) -> None:
        """Makes control vertices frames, with a rotation (3, 3) from the rest shape, one for each
        (k, 3, 3), or that of the rigid motion of their targets."""
        if rotation is None:
            self._session.set_rotations_of_motion(_indices("vertices", vertices))
        else:
            self._session.set_rotations(_indices("vertices", vertices),
                                        _rows("rotation", rotation, 3, 3))

    def erase_rotations(self, vertices: ArrayLike) -> None:
        """Lets the rotations of frames be fitted again. They stay control vertices."""
        self._session.erase_rotations(_indices("vertices", vertices))

    def set_stiffness(self, values: ArrayLike) -> None:
        """Sets how stiff cells are, not negative: (n,), or (m,) if cells are elements; []: 1.
        Pass [] before ``cells`` changes to 'elements', or from these to others."""
        self._session.set_stiffness(_floats("stiffness", values, None))

    def set_groups(self, groups: ArrayLike) -> None:
        """Lets cells with the same number from 0 on share a rotation; cells with a negative one have
        their own: (n,) or (m,); []: none. The part can still stretch: a rigid one has a large
        stiffness, too.
        Pass [] before ``cells`` changes to 'elements', or from these to others."""
        self._session.set_groups(_integers("groups", groups, None, least=-(2**31)))

    def preprocess(self) -> str:
        """Prepares what the next call of deform() needs, which it else does itself. Returns a
        message, which also says what unconstrained components there are. Not for time steps,
        which need another factorization."""
        return str(self._session.preprocess())

    def deform(self, iterations: Optional[int] = None, tolerance: Optional[float] = None,
               visitor: Optional[Visitor] = None) -> Report:
        """Moves the handles to their targets, and the rest with them. The visitor is called with
        the number and the energy of each iterate, and a function that returns a copy of its
        vertices (n, 3), for a preview; it may return 'stop', to keep the iterate, or 'cancel'. If
        it raises an exception, or is interrupted, nothing has changed."""
        options = {"iterations": iterations, "tolerance": tolerance}
        given = {name: _text(number) for name, number in options.items() if number is not None}
        return Report(**self._session.deform(given, visitor))

    def advance(self, time_step: float = 1 / 60, *, density: float = 1, modulus: float = 1,
                damping: float = 0, acceleration: ArrayLike = (0, 0, 0),
                forces: Optional[ArrayLike] = None,
                visitor: Optional[Visitor] = None) -> StepReport:
        """Advances by a time step of implicit Euler, in any consistent units: mass per area or
        volume, modulus, rate of decay of velocities, acceleration (3,), forces (n, 3)."""
        numbers = [_float(*pair) for pair in (("time_step", time_step), ("density", density),
                                              ("modulus", modulus), ("damping", damping))]
        given = _floats("forces", [] if forces is None else forces, None, 3)
        if forces is not None and not len(given) and len(self.vertices):
            raise ValueError("forces have three coordinates for each of the vertices; there are none")
        return StepReport(**self._session.advance(
            *numbers, _floats("acceleration", acceleration, 3), given, visitor))

    def velocities(self) -> Floats:
        """(n, 3): the velocities that the next step begins with; zero outside the region, and after
        ``deform()`` and ``reset()``."""
        return self._session.velocities().reshape(-1, 3)

    def set_velocities(self, vertices: ArrayLike, velocities: ArrayLike) -> None:
        """Sets the velocities (k, 3) of k vertices of the region, or the velocity (3,) of one."""
        self._session.set_velocities(*_pair("vertices", vertices, "velocities", velocities))

    def reset(self) -> None:
        """Moves all vertices and targets back to the rest shape. Keeps the weights of the targets,
        but erases prescribed rotations and velocities, and makes points of targets that are sets."""
        self._session.reset()

    def make_rest_shape(self) -> None:
        """Makes the current shape the rest shape. Keeps the targets and their weights, but erases
        prescribed rotations."""
        self._session.make_rest_shape()

    def state(self) -> State:
        """Positions, velocities, region, rest shape, and handles with targets, weights and
        rotations, as a value, for undo; not the options, the stiffness and the groups."""
        return self._session.state()

    def restore(self, state: State) -> None:
        """Returns to a state of this object."""
        if not isinstance(state, State):
            raise TypeError(f"restore() needs what state() returns, not {type(state).__name__}")
        self._session.restore(state)

    @property
    def energy(self) -> float:
        """The energy after the last run, without inertia; not a number where there is none."""
        return self._session.energy()

    def rotations(self) -> Floats:
        """(n, 3, 3), or (m, 3, 3) if cells are elements: the rotations of the cells; identities
        outside the region, where no vertex of the cell is free, as inside a handle (unless rotations
        are smoothed, or shared), and until the first run after a change of the region or the cells,
        or after `reset()` or `make_rest_shape()`."""
        return self._session.rotations().reshape(-1, 3, 3)

    def quality(self) -> Quality:
        """What was done to the rest shape."""
        return Quality(**self._session.quality())

    def quality_at_vertices(self, name: str) -> Floats:
        """(n,): 'edge_length_error', 'size_change', 'angle_change' in degrees, or 'spike'."""
        return self._session.quality_at_vertices(str(name))


def deform(vertices: ArrayLike, simplices: ArrayLike, fixed: ArrayLike, targets: Targets, *,
           tetrahedra: bool = False, weights: str = "safe_cotangent", **options: Any) -> Floats:
    """The deformed vertices (n, 3). ``fixed`` are indices of vertices that stay; ``targets`` is a
    dict of points by vertices, or a pair of k indices and points (k, 3), and prevails over
    ``fixed``. The other arguments are those of ``Deformation``, which also tells by a report
    whether the run converged."""
    session = Deformation(vertices, simplices, tetrahedra=tetrahedra, weights=weights, **options)
    handles, points = _targets(targets)
    session.insert_handles(_indices("fixed", fixed))
    session.insert_handles(handles)
    session.set_targets(handles, points)
    session.deform()
    return session.vertices.copy()
