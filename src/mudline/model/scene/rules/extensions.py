"""Suction, unloading and soil of extension keywords: their values, and the laws that they exclude."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mudline.language.diagnostics import Blocks, Code, Problem, Severity
from mudline.model.contact.input import LawKind
from mudline.model.contact.laws import Parameter
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.laws import Extension, rule_of_extension
from mudline.model.scene.numbering import Mask, marked
from mudline.model.scene.resolved import ResolvedDeck
from mudline.model.scene.rules.fields import lacks_diameter

EXT004 = Code("EXT004", "bad-cutoff", Severity.ERROR)
EXT005 = Code("EXT005", "suction-incomplete", Severity.ERROR)
EXT006 = Code("EXT006", "suction-conflict", Severity.ERROR)
EXT009 = Code("EXT009", "unloading-conflict", Severity.ERROR)

_LOWEST, _HIGHEST = 0.01, 0.99


def of_elements(scene: ResolvedDeck, elements: Mask, problem: Problem) -> Iterator[Problem]:
    """Yield a problem of the elements (m,) of a mask, if there are any; its message says what they have."""
    if elements.any():
        yield replace(problem, message=f"{scene.describe(elements)} {problem.message}")


@rule_of_extension(EXT004, "SEABED SUCTION")
def bad_cutoff(_: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """The corners of the suction trapezoid are out of order or out of range.

    Suction rises up to the first corner, holds, and falls from the second corner to breakout. Both are fractions of the
    suction depth, 0.01 <= first <= second <= 0.99, so that rise and fall have a finite slope. Correct them.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SUCTION
        | SET=ALL
        | COHESION=5000.0
        - CUTOFF=0.8, 0.2
        + CUTOFF=0.2, 0.8

    Finds: 9:2
    """
    for entry, where in zip(extension.entries, extension.places, strict=True):
        corners = [number(getattr(entry, "cutoff", None), name) for name in ("first", "second")]
        known = [corner for corner in corners if np.isfinite(corner)]
        if any(not _LOWEST <= corner <= _HIGHEST for corner in known) or known != sorted(known):
            message = f"corners {', '.join(map(repr, known))}: they must be 0.01 <= first <= second <= 0.99"
            yield Problem(EXT004, message, where=where.inside("cutoff"))


@rule_of_extension(EXT005, "SEABED SUCTION")
def suction_incomplete(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """A suction law lacks a value that it needs.

    COHESION= gives both the largest force and the suction depth, computed with the external diameter of the elements.
    Without it FORCE= and DEPTH= are both required; if they are given, they override it. The relation between cohesion
    and depth is not dimensionally homogeneous, and the default of REGULARISATION= is in m/s. In user units neither can
    be converted, so FORCE=, DEPTH= and REGULARISATION= must all be given. Give the missing values.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SUCTION
        | SET=ALL
        | FORCE=3500.0, 0.18
        + DEPTH=0.3, 0.26

    Finds: 7:6
    """
    user = scene.units == "user"
    bare = (scene.law != LawKind.RIGID) & np.isnan(scene.diameter) & ~scene.section_table.faulty
    for entry, where, held in extension.blocks():
        lacks = {key for key in ("cohesion", "force", "depth", "regularisation") if getattr(entry, key, None) is None}
        title, cohesion = where.inside("set"), where.inside("cohesion")
        unsized = bare & held
        if missing := " and ".join(f"{key.upper()}=" for key in ("force", "depth") if key in lacks):
            if "cohesion" in lacks:
                yield Problem(EXT005, f"the suction law is incomplete: give COHESION=, or {missing}", where=title)
            elif user:
                message = (
                    "COHESION= needs metric or imperial units, and the deck has user units: give FORCE= and DEPTH="
                )
                yield Problem(EXT005, message, where=cohesion)
            elif unsized.any():
                what = scene.describe(unsized)
                yield lacks_diameter(scene, EXT005, f"COHESION= needs the external diameter, and {what} none", cohesion)
        if user and "regularisation" in lacks:
            yield Problem(EXT005, "REGULARISATION= is missing: with user units it has no default; give it", where=title)


@rule_of_extension(EXT006, "SEABED SUCTION")
def suction_conflict(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """Elements have two suction laws.

    *SEABED SUCTION describes the whole uplift resistance of an element. SUCTION= of *SEABED PROPERTIES, or a curve with
    negative forces below the mudline, would hold the pipe a second time. Remove one of them. With `--tension cut` the
    negative forces of a curve are left out, and only one law remains: the deck can then be evaluated. A curve that is
    negative only in its extrapolation is a warning; a position that reaches this part is refused.

    Example on pipe:
          STIFFNESS=50000.0
        | SUCTION=8000.0, 0.15
        -*SEABED SUCTION
        - SET=ALL
        - COHESION=5000.0

    Finds: 19:6
    """
    springs = (scene.resistance.column("suction") > 0.0) & (scene.law != LawKind.RIGID)
    curves = [entry for entry in scene.laws.curves if entry.curve is not None]
    index = scene.law_arrays().curve_index
    listed, extrapolated = (marked(map(pulls, curves), index) for pulls in (_lists_pull, _may_pull))
    for _, where, held in extension.blocks():
        place = where.inside("set")
        words = "SUCTION= of the seabed too: remove one of the two"
        yield from of_elements(scene, held & springs, Problem(EXT006, words, where=place))
        words = (
            "a curve that is negative in contact too: remove one of the two, unless the curve is evaluated with "
            "--tension cut"
        )
        problem = Problem(EXT006, words, where=place, blocks=Blocks.WITH_TENSION)
        yield from of_elements(scene, held & listed, problem)
        words = (
            "a curve that is negative in contact too where it is extrapolated: `evaluate` refuses a position there; "
            "correct the curve, or evaluate it with --tension cut"
        )
        problem = Problem(EXT006, words, None, Severity.WARNING, place)
        yield from of_elements(scene, held & extrapolated & ~listed, problem)


def _lists_pull(entry: SceneCurve) -> bool:
    """Return True if a curve has a point with a negative force below the mudline."""
    return bool((entry.points[entry.points[:, 0] > 0.0, 1] < 0.0).any())


def _may_pull(entry: SceneCurve) -> bool:
    """Return True if the force of a curve is negative at the mudline, or decreases beyond its last point."""
    if entry.curve is None:
        return False
    force, slope = entry.curve.evaluate(np.array([0.0, max(0.0, float(entry.curve.ratios[-1]))]))
    return bool(force[0] < 0.0 or force[1] < 0.0 or slope[1] < 0.0)


@rule_of_extension(EXT009, "SEABED UNLOADING")
def unloading_conflict(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """Unloading is combined with smoothing or a nodal stiffness, or its stiffness is not above 0.

    Smoothing and unloading both change the reaction near the seabed, and there is no law for the two together.
    *SEABED CONTACT smooths a linear law unless it says SMOOTHING=NONE. Write that, or remove the unloading. The
    unloading stiffness is a divisor and must be above 0. SMOOTHING=AUTO has no effect if the submerged weight is not
    known, or is not above 0. NODAL STIFFNESS= replaces the law per unit length that would be unloaded.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED UNLOADING
        | SET=ALL
        - STIFFNESS=0.0
        + STIFFNESS=500000.0

    Finds: 8:12
    """
    smooth, nodal = np.zeros(len(scene.element_ids), dtype=np.bool_), scene.law == LawKind.NODAL
    if "SEABED CONTACT" in scene.extensions:
        from mudline.model.scene.assignments import element_smoothing  # noqa: PLC0415 - only now is it needed

        smooth[element_smoothing(scene).rows] = True
    for entry, where, held in extension.blocks():
        stiffness = number(entry, "stiffness")
        if stiffness <= 0.0:
            message = f"unloading stiffness {stiffness!r}: it must be above 0"
            yield Problem(EXT009, message, where=where.inside("stiffness"))
        words = "smoothing too: write SMOOTHING=NONE in *SEABED CONTACT, or remove the unloading"
        yield from of_elements(scene, held & smooth, Problem(EXT009, words, where=where.inside("set")))
        words = "NODAL STIFFNESS=, which does not unload along a line of its own: remove one of the two"
        yield from of_elements(scene, held & nodal, Problem(EXT009, words, where=where.inside("set")))


EXT010 = Code("EXT010", "soil-conflict", Severity.ERROR)
EXT011 = Code("EXT011", "impossible-soil", Severity.ERROR)
EXT012 = Code("EXT012", "unusual-soil", Severity.WARNING)

_KEYWORD = "SEABED SOIL"
_USUAL = {"factor": (5.0, 7.0), "exponent": (0.2, 0.3), "stiffness": (50.0, 500.0), "suction": (0.0, 1.0)}
"""Range in published soils, by parameter of the law."""
_NAMES = {"factor": "a of BEARING=", "exponent": "b of BEARING=", "stiffness": "K_max", "suction": "f_suc"}


def _fields(extension: Extension) -> Iterator[tuple[int, Parameter, tuple[str, ...], float]]:
    """Yield the block, parameter, path and value of every number that a block gives."""
    from mudline.model.contact.laws.soil import SOIL  # noqa: PLC0415 - most decks have no soil
    from mudline.model.scene.assignments import SOIL_FIELDS  # noqa: PLC0415 - as above

    for index, entry in enumerate(extension.entries):
        for parameter in SOIL.parameters:
            path = SOIL_FIELDS.get(parameter.name, ())
            holder = getattr(entry, path[0], None) if len(path) == 2 else entry
            value = number(holder, path[-1]) if path else np.nan
            if np.isfinite(value):
                yield index, parameter, path, value


@rule_of_extension(EXT010, _KEYWORD)
def soil_conflict(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """An element with *SEABED SOIL has another law for its normal reaction.

    The soil describes the resistance against penetration, uplift and renewed penetration. *SEABED SUCTION and
    *SEABED UNLOADING would add a second law for them, and NODAL STIFFNESS= of *SEABED CONTACT replaces them all: remove
    one of the two. The soil replaces the curve of an element, which is an info. It also replaces the number that the
    keyword family requires, which is not reported.

    Example on pipe:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        | STRENGTH=5000.0, 1500.0
        -*SEABED UNLOADING
        - SET=ALL
        - STIFFNESS=500000.0

    Finds: 18:6
    """
    soft = scene.laws_given != LawKind.RIGID
    beside = {
        f"*{keyword}": scene.extensions[keyword].of_element >= 0
        for keyword in ("SEABED SUCTION", "SEABED UNLOADING")
        if keyword in scene.extensions
    }
    beside["NODAL STIFFNESS="] = scene.nodal
    for _, where, held in extension.blocks():
        place = where.inside("set")
        for name, others in beside.items():
            words = f"{name} too, which the soil has no place for: remove one of the two"
            yield from of_elements(scene, held & soft & others, Problem(EXT010, words, where=place))
        replaced = Problem(EXT010, "a curve too: the soil replaces it", None, Severity.INFO, place)
        yield from of_elements(scene, held & (scene.laws_given == LawKind.CURVE), replaced)


@rule_of_extension(EXT011, _KEYWORD)
def impossible_soil(_: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """A value of *SEABED SOIL is impossible for a soil.

    Strength at the mudline, bearing factor and exponent, K_max and the decay length of suction are divisors or raised
    to powers, and must be above 0. A strength that decreases with depth would become negative. Ratios, weights and
    factors below 0 have no meaning. Correct the value.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        - STRENGTH=5000.0, -1500.0
        + STRENGTH=5000.0, 1500.0

    Finds: 8:19
    """
    for index, parameter, path, value in _fields(extension):
        if parameter.invalid(np.array([value]))[0]:
            message = f"{value!r}: expected {parameter.valid_range} for the {parameter.meaning.split(', ')[-1]}"
            yield Problem(EXT011, message, where=extension.places[index].inside(*path))
    for entry, where in zip(extension.entries, extension.places, strict=True):
        for name in ("factor", "weight"):
            value = number(getattr(entry, "buoyancy", None), name)
            if value < 0.0:
                message = f"{value!r}: expected >= 0 for the {name} of BUOYANCY="
                yield Problem(EXT011, message, where=where.inside("buoyancy", name))


@rule_of_extension(EXT012, _KEYWORD)
def unusual_soil(scene: ResolvedDeck, extension: Extension) -> Iterator[Problem]:
    """A value of *SEABED SOIL is outside the range of published soils, or its units cannot be checked.

    Bearing factors have a from 5 to 7 and b from 0.2 to 0.3, K_max is from 50 to 500, and suction is at most as large
    as the resistance against penetration. Usually the value is in another unit or in the wrong field. In user units the
    numbers are taken as they are, which is an info: use one system for lengths and forces.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        | STRENGTH=5000.0, 1500.0
        - BEARING=6000.0, 0.25
        + BEARING=6.0, 0.25

    Finds: 9:10
    """
    for index, parameter, path, value in _fields(extension):
        low, high = _USUAL.get(parameter.name, (-np.inf, np.inf))
        if not low <= value <= high and not parameter.invalid(np.array([value]))[0]:
            usual = f"{_NAMES[parameter.name]} is {low:g} to {high:g} in published soils"
            message = f"{value:g}: {usual}; correct it if it is a slip"
            yield Problem(EXT012, message, where=extension.places[index].inside(*path))
    if scene.units == "user":
        message = "the deck has user units: strength, weight and diameter must be in one system"
        for where in extension.places[:1]:
            yield Problem(EXT012, message, None, Severity.INFO, where.inside("strength"))
