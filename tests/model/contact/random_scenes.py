"""Random scenes, and whether both drivers give the same bits for them: python -m tests.model.contact.random_scenes 1000

A scene may have any of the laws, any seabed, lines that branch or are numbered in any order, sizes up to 1e300, nodes
without position, and repeated or standing motions. It is evaluated at once, in parts, step by step, on one thread and
on several, with numpy and with the loops: all give the same bits, or all raise the same error.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from importlib.util import find_spec
from typing import Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from mudline.model.contact import ContactInput, LawAssignment
from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.laws.trench import diagram, rounded
from mudline.model.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed
from mudline.model.contact.seabed.profile import ProfileSeabed
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import ALONG_Y, FRICTION, bridge_law, floats, friction, on, suction
from tests.model.contact.comparison import Scene, Sizes, compare

NORMAL = ("linear", "smoothed", "curve", "soil", "rigid")
BESIDE = ("unloading", "suction spring", "damping", "suction", "lateral")
TRENCHES = ("trench peak", "trench wall", "trench table", "trench level")
LAWS = (*NORMAL, "nodal", "nodal damping", *BESIDE, "friction", "breakout", *TRENCHES)
"""All laws; in scenes each is on some elements or nodes."""
SUBSETS: tuple[tuple[frozenset[str], bool], ...] = (
    (frozenset({"curve", "linear", "smoothed", "soil", "unloading", "suction spring", "damping", "suction"}), True),
    (frozenset({"linear", "nodal", "nodal damping", "friction", "breakout", "lateral"}), False),
)
"""Laws of the scenes of the suite, and whether their seabed is flat: each has loops of its own, compiled once."""
SIZES = (1e-300, 1e-160, 1e-100, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e100, 1e160, 1e300)
LARGEST = 1.7e308
Item = TypeVar("Item")


class _Random:
    """Draws what a scene is made of."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def pick(self, items: Sequence[Item]) -> Item:
        return items[int(self.rng.integers(len(items)))]

    def some(self, count: int, share: float = 0.6) -> IndexArray:
        """Some of as many rows, in any order."""
        return self.rng.permutation(np.flatnonzero(self.rng.random(count) < share))

    def values(self, count: int, low: float, high: float, *odd: float) -> FloatArray:
        """Values between two, and now and then an odd one."""
        found = self.rng.uniform(low, high, count)
        if odd and self.chance(0.5):
            found = np.where(self.rng.random(count) < 0.4, self.rng.choice(np.array(odd), count), found)
        return found

    def scaled(self, count: int, low: float, high: float, size: float, *odd: float) -> FloatArray:
        """Values between two times a size."""
        with np.errstate(over="ignore"):
            return np.clip(self.values(count, low, high, *odd) * size, 0.0, LARGEST)


class _Line(NamedTuple):
    """Places (n, 3) of nodes, and the nodes (m, 2) of elements."""

    points: FloatArray
    ends: IndexArray


def _line(random: _Random) -> _Line:
    """Lines that may branch, double, or run from a node to itself, numbered in any order."""
    points: list[list[float]] = []
    ends: list[list[int]] = []
    for _ in range(random.pick((1, 1, 1, 2, 3))):
        count, first = random.pick((1, 1, 2, 3, 5, 8)), len(points)
        start, heading = random.rng.uniform(-6.0, 6.0, 2), random.rng.uniform(-np.pi, np.pi)
        for node in range(count + 1):
            points.append([random.rng.uniform(-0.06, 0.02), *start])
            heading += random.rng.normal(scale=0.3)
            start = start + random.rng.uniform(0.5, 2.5) * np.array([np.cos(heading), np.sin(heading)])
            if node:
                ends.append([first + node - 1, first + node])
    places, nodes = np.array(points), np.array(ends, np.intp)
    if random.chance(0.3):
        extra = random.rng.integers(0, len(places), (random.pick((1, 2, 4)), 2))
        nodes = np.concatenate([nodes, extra, nodes[: random.pick((0, 0, 1))]])
    if random.chance(0.1):
        nodes[-1, 1] = nodes[-1, 0]
    if random.chance(0.1):
        places = np.concatenate([places, places[:1] + 3.0])
    return _numbered(random, places, nodes)


def _numbered(random: _Random, places: FloatArray, nodes: IndexArray) -> _Line:
    """The same line with nodes and elements in some order."""
    kind = random.pick(("as it runs", "as it runs", "ends first", "any"))
    order = np.arange(len(places))
    if kind == "ends first":
        order = np.r_[0, len(places) - 1, np.arange(1, len(places) - 1)] if len(places) > 1 else order
    elif kind == "any":
        order = random.rng.permutation(len(places))
        nodes = nodes[random.rng.permutation(len(nodes))]
    if random.chance(0.3):
        nodes = np.where((random.rng.random(len(nodes)) < 0.5)[:, None], nodes[:, ::-1], nodes)
    return _Line(places[order], np.argsort(order)[nodes])


def _with_block(line: _Line) -> _Line:
    """The line, and five elements beside it which have all laws, see `_laws_of_block`."""
    first = len(line.points)
    places = np.zeros((6, 3))
    places[:, 0], places[:, 1], places[:, 2] = -0.03, 0.5 * np.arange(6), 0.7
    ends = first + np.column_stack([np.arange(5), np.arange(1, 6)])
    return _Line(np.concatenate([line.points, places]), np.concatenate([line.ends, ends]))


def _laws_of_block(line: _Line) -> Iterator[LawAssignment]:
    """Laws of these names with everything that loops differ by, on the five elements and six nodes at the end."""
    row, node = len(line.ends) - 5, len(line.points) - 6
    law = bridge_law(1)._replace(cyclic=floats(0.9), cyclic_floor=floats(0.5))
    widths = {"bottom": 0.02, "upper": 0.4}
    yield on("curve", [row], curve=0)
    yield on("linear", [row + 1], stiffness=2e4)
    yield on("smoothed", [row + 2], stiffness=2e4, half_width=0.01)
    yield on("rigid", [row + 3])
    yield on("soil", [row + 4], strength=5e3, gradient=1.5e3)
    yield on("nodal", [node + 4], stiffness=1e4)
    yield on("damping", [row], damping=1e3)
    yield on("nodal damping", [node], damping=1e3)
    yield on("unloading", [row, row + 1, row + 2], stiffness=1.0)
    yield on("suction spring", [row], stiffness=800.0, extent=0.2)
    yield suction(law, [row])
    yield on("lateral", [row], stiffness=900.0)
    yield friction([node], ellipse=True, angle=30.0)
    yield friction([node + 1, node + 2], stiffness=np.nan, mobilisation=0.02)
    yield on("breakout", [node + 2], peak_displacement=0.02, peak_growth=0.1, residual=0.4, residual_displacement=0.2)
    yield on("trench peak", [row], peak=300.0, **widths)
    yield on("trench wall", [row + 1], depth=0.05, **widths)
    yield on("trench table", [row + 2], table=0, **widths)


_CLOUD = np.vstack(
    [
        [[0.0, -40.0, -40.0], [0.1, 40.0, -40.0], [-0.1, -40.0, 40.0], [0.1, 40.0, 40.0]],
        np.random.default_rng(7).uniform((-0.3, -39.0, -39.0), (0.3, 39.0, 39.0), (30, 3)),
    ]
)


@cache
def _scattered(interpolation: Literal["LINEAR", "CUBIC"]) -> Seabed:
    """The surfaces through these points, made once each: searches among new triangles are slow at first."""
    from mudline.model.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - needs scipy

    return ScatteredSeabed(_CLOUD, interpolation)


def _seabed(random: _Random) -> Seabed | None:
    """A seabed of any shape; None for a flat one."""
    wide = [-1e9, 1e9, -1e9, 1e9]
    shapes: list[Callable[[], Seabed | None]] = [
        lambda: None,
        FlatSeabed,
        lambda: SlopingSeabed(float(random.rng.uniform(-20.0, 20.0)), float(random.rng.uniform(-180.0, 180.0))),
        lambda: SlopingSeabed(random.pick((0.0, 45.0, 89.999)), random.pick((0.0, 90.0, 33.0))),
        lambda: PlanesSeabed([[0.0, 0.0, 0.0]], [float(random.rng.uniform(-10.0, 10.0))], [30.0]),
        lambda: PlanesSeabed(
            [[0.0, 0.0, 0.0], [0.01, 1.0, 0.0]], [2.0, -5.0], [0.0, 80.0], [wide, [-3.0, 3.0, -2.0, 2.0]]
        ),
        lambda: PlanesSeabed([[0.0, 0.0, 0.0]], [3.0], [10.0], [[-4.0, 4.0, -4.0, 4.0]]),
        lambda: ProfileSeabed([-5.0, 0.0, 2.0, 7.0], [0.1, -0.1, 0.2, 0.0], "LINEAR", 20.0),
        lambda: ProfileSeabed([-5.0, 0.0, 2.0, 7.0], [0.1, -0.1, 0.2, 0.0], "CUBIC SPLINE"),
        lambda: ProfileSeabed([-5.0, 0.0, 2.0, 7.0], [0.1, -0.1, 0.2, 0.0], "CUBIC BESSEL", -70.0),
    ]
    if find_spec("scipy") is not None:
        shapes += [lambda: _scattered("LINEAR"), lambda: _scattered("CUBIC")]
    return shapes[0]() if random.chance(0.4) else random.pick(shapes)()


def _seabed_like(random: _Random, *, flat: bool) -> Seabed | None:
    """A seabed that is flat, or one that is not."""
    if flat:
        return None
    while isinstance(found := _seabed(random), FlatSeabed | None):
        pass
    return found


def _curve(random: _Random, size: float) -> ForceCurve:
    count = random.pick((2, 2, 3, 5, 9, 40, 200))
    ratios = np.cumsum(random.rng.uniform(0.005, 1.0 / count, count)) + random.pick((0.0, 0.0, -0.3, 0.02))
    if random.chance(0.5) and 0.0 < ratios[0] < 0.02:
        ratios[0] = 0.0
    forces = np.cumsum(random.rng.uniform(-0.1 if random.chance(0.4) else 0.0, 1.0, count)) * 5000.0 / count
    forces -= random.pick((0.0, 0.0, forces[0], 800.0))
    return ForceCurve(np.column_stack([ratios, np.clip(forces * size, -1e303, 1e303)]))


def _beside_parameters(random: _Random, name: str, count: int, size: float) -> dict[str, ArrayLike]:
    """Parameters of a law of elements."""
    exponents = (0.0, 0.18, 0.26, 1.0, 1.5, 2.0, 2.5)
    half = random.scaled(count, 0.0, 0.03, 1.0, 0.0, 5e-324, 1e-300)
    sided = random.rng.integers(0, 2, count)
    first = random.values(count, 0.01, 0.6, 0.2)
    makers: dict[str, Callable[[], dict[str, ArrayLike]]] = {
        "linear": lambda: {"stiffness": random.scaled(count, 0.0, 1e5, size, 0.0)},
        "smoothed": lambda: {
            "stiffness": random.scaled(count, 0.0, 1e5, size, 0.0), "half_width": half, "one_sided": sided,
        },
        "nodal": lambda: {
            "stiffness": random.scaled(count, 0.0, 1e5, size, 0.0), "half_width": half, "one_sided": sided,
        },
        "soil": lambda: {
            "strength": np.maximum(random.scaled(count, 500.0, 1e4, size, 5e3), 5e-324),
            "gradient": random.scaled(count, 0.0, 3e3, size, 0.0),
            "exponent": random.values(count, 0.2, 0.3, 0.25),
            "stiffness": random.values(count, 50.0, 500.0, 200.0, 1e6),
            "suction": random.values(count, 0.0, 1.0, 0.0, 0.6),
            "suction_decay": random.values(count, 0.1, 2.0, 1e12),
            "repenetration": random.values(count, 0.0, 1.5, 0.0, 0.3),
            "buoyancy": random.scaled(count, 0.0, 1e4, size, 0.0),
        },
        "unloading": lambda: {"stiffness": np.maximum(random.scaled(count, 1.0, 5e5, size, 1.0), 5e-324)},
        "suction spring": lambda: {
            "stiffness": random.scaled(count, 0.0, 5e3, size, 0.0), "extent": random.values(count, 0.0, 0.2, 0.0),
        },
        "suction": lambda: {
            "force_factor": random.scaled(count, 0.0, 3e3, size, 0.0),
            "force_exponent": random.values(count, 0.0, 2.5, *exponents),
            "depth_factor": np.maximum(random.scaled(count, 0.01, 0.5, 1.0, 1e-300), 5e-324),
            "depth_exponent": random.values(count, 0.0, 1.5, *exponents),
            "first_corner": first,
            "second_corner": np.maximum(first, random.values(count, 0.1, 0.99, 0.8)),
            "cyclic": random.values(count, 0.0, 1.0, 0.9, 1.0, 0.0),
            "regularisation": random.values(count, 0.0, 0.1, 0.0, 1e-3, 1e-300),
            "cyclic_floor": np.where(random.rng.random(count) < 0.5, random.values(count, 0.0, 1.0, 0.5), np.nan),
        },
        "lateral": lambda: {"stiffness": random.scaled(count, 0.0, 5e3, size, 0.0)},
        "damping": lambda: {"damping": random.scaled(count, 0.0, 5e3, size, 0.0)},
        "nodal damping": lambda: {"damping": random.scaled(count, 0.0, 5e3, size, 0.0)},
    }  # fmt: skip
    return makers[name]()


def _friction(random: _Random, nodes: int, size: float) -> LawAssignment:
    rows = random.some(nodes, 0.9)
    count = len(rows)
    constant = np.where(
        random.rng.random((count, 2)) < 0.5,
        np.maximum(random.scaled(2 * count, 1.0, 1e5, size), 1e-320).reshape(-1, 2),
        np.nan,
    )
    columns = [
        *random.values(2 * count, 0.0, 1.2, 0.0, 0.5).reshape(2, count),
        *constant.T,
        *np.maximum(random.values(2 * count, 1e-3, 0.1, 1e-300), 5e-324).reshape(2, count),
        random.rng.integers(0, 2, count) * random.pick((0.0, 1.0)),
        np.where(random.rng.random(count) < random.pick((0.0, 0.5)), random.values(count, -400.0, 400.0, 0.0), np.nan),
    ]
    return on("friction", rows, **dict(zip(FRICTION, columns, strict=True)))


def _breakout(random: _Random, friction: LawAssignment) -> LawAssignment:
    """On some nodes without an ellipse, some with a growth with z/D."""
    rows = friction.rows[np.asarray(friction.parameters["elliptic"]) == 0.0]
    rows = rows[random.some(len(rows))]
    count = len(rows)
    peak, growth = random.values(count, 1e-3, 0.05, 1e-300), random.values(count, 0.0, 0.1, 0.0)
    return on(
        "breakout",
        rows,
        peak_displacement=peak,
        peak_growth=growth * random.pick((0.0, 1.0)),
        residual=random.values(count, 0.0, 1.2, 0.0, 1.0),
        residual_growth=random.values(count, 0.0, 0.5, 0.0),
        residual_displacement=peak + growth + random.values(count, 1e-3, 0.2),
    )


def _trench(random: _Random, name: str, elements: int, size: float) -> LawAssignment:
    rows = random.some(elements, 0.7)
    count = len(rows)
    bottom = random.values(count, 0.005, 0.3, 0.02)
    straight = np.tile(random.values(4, -3.0, 3.0), (count, 1))
    straight[random.rng.random(count) < random.pick((0.4, 1.0))] = np.nan
    given: dict[str, ArrayLike] = {
        "bottom": bottom,
        "upper": bottom + random.values(count, 0.02, 0.6, 0.4),
        **dict(zip(ALONG_Y, straight.T, strict=True)),
    }
    if name == "trench peak":
        given["peak"] = random.scaled(count, 0.0, 1e3, size, 0.0, 1e-12)
    elif name in {"trench wall", "trench level"}:
        given["depth"] = random.values(count, 1e-3, 0.01, 1e-9)
    else:
        given["table"] = random.rng.integers(0, 3, count)
    return on(name, rows, **given)


_TABLES = (
    np.array([[0.01, 100.0], [0.1, 400.0], [0.3, 50.0]]),
    rounded(diagram(0.02, 0.3, 400.0, (120.0, 0.4)), 0.03),
    np.column_stack([np.linspace(0.0, 0.5, 40), np.linspace(0.0, 300.0, 40) ** 1.5]),
)


def _laws(
    random: _Random, names: frozenset[str], line: _Line, size: float, *, block: int = 0
) -> tuple[LawAssignment, ...]:
    """Laws of these names on some elements and nodes, but for a block at the end."""
    elements, nodes = len(line.ends) - block, len(line.points) - (block and block + 1)
    wanted = [name for name in NORMAL if name in names]
    kind = random.rng.integers(0, len(wanted) + random.pick((0, 1)) or 1, elements)
    found = []
    for number, name in enumerate(wanted):
        rows = np.flatnonzero(kind == number)
        if name == "curve":
            found.append(on(name, rows, curve=random.rng.integers(0, 2, len(rows))))
        elif name == "rigid":
            found.append(on(name, rows))
        else:
            found.append(on(name, rows, **_beside_parameters(random, name, len(rows), size)))
    for name in (*BESIDE, "nodal", "nodal damping"):
        if name in names:
            rows = random.some(nodes if name.startswith("nodal") else elements)
            if name in {"unloading", "suction"}:  # a soil has its own
                rows = rows[
                    ~np.isin(rows, np.concatenate([np.zeros(0), *(law.rows for law in found if law.law == "soil")]))
                ]
            found.append(on(name, rows, **_beside_parameters(random, name, len(rows), size)))
    if "friction" in names:
        found.append(_friction(random, nodes, size))
    found += [_trench(random, name, elements, size) for name in TRENCHES if name in names]
    if {"friction", "breakout"} <= names:
        found.append(_breakout(random, next(law for law in found if law.law == "friction")))
    return tuple(found)


def _motion(random: _Random, line: _Line, seabed: Seabed | None, size: float) -> FloatArray:
    """Positions (steps, n, 3) that heave, drift, rest and come back."""
    steps = random.pick((1, 2, 5, 12, 12, 20, 33))
    shape = (steps, len(line.points), 3)
    moves = random.rng.normal(scale=(0.03, 0.02, 0.03), size=shape)
    moves += random.rng.normal(scale=(0.04, 0.02, 0.04), size=(steps, 1, 3))
    moves[random.rng.random(steps) < 0.15] = 0.0
    moves[..., 1:] *= random.pick((0.0, 0.1, 1.0, 1.0))
    places = line.points + np.cumsum(moves, axis=0)
    if random.chance(0.3):
        places = np.round(places / 0.0125) * 0.0125
    if random.chance(0.2):
        places[steps // 2 :] = places[: steps - steps // 2]
    if random.chance(0.05):
        places[:, -1] = places[:, 0]
    if seabed is not None:
        with np.errstate(all="ignore"):
            places[..., 0] += np.nan_to_num(seabed.elevation(places[..., 1], places[..., 2]))
    with np.errstate(over="ignore"):
        return np.clip(places * np.where(random.rng.random(3) < 0.6, size, 1.0), -LARGEST, LARGEST)


def random_scene(seed: int, names: frozenset[str] | None = None, *, flat: bool | None = None) -> Scene:
    """Return a scene with laws of these names, or of any; the same for the same seed.

    Where it is said whether the seabed is `flat`, all scenes with these laws have the same loops.
    """
    random = _Random(seed)
    if names is None:
        drawn = frozenset(name for name in LAWS if random.chance(random.pick((0.2, 0.5, 0.8))))
        names = random.pick((frozenset(LAWS), drawn, drawn))
    extreme = random.chance(0.35)
    size, force, speed, long = (random.pick(SIZES) if extreme and random.chance(0.5) else 1.0 for _ in range(4))
    line, seabed = _line(random), _seabed(random)
    if flat is not None:
        line, seabed = _with_block(line), _seabed_like(random, flat=flat)
    elements, nodes = len(line.ends), len(line.points)
    diameter = random.values(elements, 0.05, 1.0, 0.3)
    laws = _laws(random, names, line, force, block=5 if flat is not None else 0)
    if flat is not None:
        laws += tuple(law for law in _laws_of_block(line) if law.law in names)
    if random.chance(0.3):
        sized = np.zeros(elements, np.bool_)
        for law in laws:
            if law.law in {"curve", "soil"}:
                sized[law.rows] = True
        diameter[np.flatnonzero(~sized)[::2]] = np.nan
    if extreme and random.chance(0.2):
        diameter *= random.pick(SIZES[3:10])
    positions = _motion(random, line, seabed, size)
    steps = len(positions)
    with np.errstate(over="ignore"):
        rates = np.clip(random.rng.normal(scale=0.2, size=positions.shape) * speed, -LARGEST, LARGEST)
        length = np.clip(random.values(elements, 0.1, 3.0, 0.0) * long, 0.0, LARGEST)
    rates[random.rng.random(steps) < 0.1] = 0.0
    timed = random.chance(0.4)
    return Scene(
        ContactInput(
            node_ids=101 + np.arange(nodes),
            coordinates=line.points,
            element_ids=11 + np.arange(elements),
            element_nodes=line.ends,
            length=length,
            diameter=diameter,
            laws=laws,
            curves=(_curve(random, force), _curve(random, force)),
            tables=_TABLES,
            tension="cut" if flat is not None or random.chance(0.4) else "keep",
            seabed=seabed,
        ),
        positions,
        None if timed else rates,
        np.cumsum(random.rng.uniform(0.01, 0.5, steps)) if timed else None,
        random.rng.random(nodes) < 0.8 if random.chance(0.2) else None,
        Sizes(random.pick((8, 16384)), random.pick((1, 5, 16)), random.pick((1, 2, 4))),
    )


def main(scenes: int) -> int:
    """Compare the drivers on so many scenes, with loops of plain Python; 1 behind the first that differs."""
    for seed in range(scenes):
        if found := compare(random_scene(seed), plain=True):
            sys.stdout.write("\n  ".join([f"seed {seed} differs:", *found[:8]]) + "\n")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
