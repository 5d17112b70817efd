"""Load case of a deck: the motion of a line's top in its waves, its time steps and its time integration."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.basics.units import UNITS
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.values import Names
from mudline.model.scene.data_files import operators
from mudline.model.scene.deck_values import find_file, number
from mudline.model.scene.numbering import Floats
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import TimeSpan, TimeStepping
    from mudline.language.keywords.library.random_seas import JonswapSeas
    from mudline.language.keywords.library.vessel_motions import Raos, VesselRao
    from mudline.language.keywords.library.waves import RegularWaves, StokesWave


class TopMotion(NamedTuple):
    """Motion of the upper end of a line: amplitudes as complex numbers with one time origin, in the deck's units.

    heave: upward.
    surge: away from the lower end.
    period: period of the motion.
    source: origin of the motion in words.
    line: line of the deck, 0 for none.
    """

    heave: complex
    surge: complex
    period: float
    source: str
    line: int


class _Wave(NamedTuple):
    """Wave that moves a vessel: its amplitude, period and direction; `height` is the symbol of its height."""

    amplitude: float
    period: float
    direction: float
    height: str
    where: Where


_DEFAULT_HEAVE, _DEFAULT_PERIOD = 1.0, 10.0
"""Default heave and period in metres and seconds, if a deck has no waves."""
_PEAK_OVER_MEAN = 1.29
"""Ratio of peak period to mean zero up-crossing period of a Jonswap sea with a peakedness of 3.3."""
_HALF_TURN, _WHOLE_TURN = 180.0, 360.0
_MOTIONS = ("heave", "surge", "sway", "yaw", "roll", "pitch")


def top_motion(
    scene: ResolvedDeck, vessel: str, direction: Floats, heave: float | None = None, period: float | None = None
) -> TopMotion:
    """Return the motion of the top of a line that a vessel moves.

    `direction` (2,) is that of the line from its lower end; `heave` and `period` replace those of the deck.
    """
    waves = _waves(scene)
    if waves:
        found = _moved(scene, waves[0], vessel, direction)
    else:
        unread = any(name.startswith("WAVE-") for name in scene.deck.keywords("LOAD CASE"))
        why = "its waves are not read" if unread else "no waves"
        found = TopMotion(_DEFAULT_HEAVE / UNITS[scene.units].length, 0.0, _DEFAULT_PERIOD, f"assumed, {why}", 0)
    if heave is not None:
        found = found._replace(heave=heave, surge=0.0, source="as asked", line=0)
    return found if period is None else found._replace(period=period)


def _waves(scene: ResolvedDeck) -> list[_Wave]:
    """Return the waves of the deck that are read: a Stokes wave, the highest of regular waves, the sea."""
    stokes, regular, seas = list[_Wave](), list[_Wave](), list[_Wave]()
    for where, block in scene.deck.blocks("WAVE-STOKES", "LOAD CASE"):
        wave = cast("StokesWave", block)
        airy, period = number(wave, "airy_amplitude", 0.0), number(wave, "period")
        amplitude = airy if airy > 0.0 else 0.5 * number(wave, "height")
        own = number(wave, "airy_period", period) if airy > 0.0 else period
        stokes.append(_Wave(amplitude, own, number(wave, "direction", 0.0), "H", where))
    for where, block in scene.deck.blocks("WAVE-REGULAR", "LOAD CASE"):
        for row in (entry.wave for entry in cast("RegularWaves", block).waves):
            direction = number(row, "direction", 0.0)
            regular.append(_Wave(number(row, "amplitude"), number(row, "period"), direction, "H", where))
    gravity = scene.surroundings.gravity
    for where, block in scene.deck.blocks("WAVE-JONSWAP", "LOAD CASE"):
        for sea in cast("JonswapSeas", block).seas:
            if (given := sea.area_height or sea.progression_height) is not None:
                period = number(given, "period") * (_PEAK_OVER_MEAN if sea.spec == "HSTZ" else 1.0)
                height = number(given, "height")
            elif (shape := sea.area_shape or sea.progression_shape) is not None:
                period = 1.0 / max(number(shape, "peak", 0.0), 1e-300)
                height = _significant_height(number(shape, "phillips"), number(shape, "peakedness"), period, gravity)
            else:
                continue
            seas.append(_Wave(0.5 * height, period, number(given or shape, "direction", 0.0), "Hs", where))
    stokes, regular, seas = (list(filter(_is_usable, waves)) for waves in (stokes, regular, seas))
    return [*stokes, *sorted(regular, key=lambda wave: -wave.amplitude), *seas]


def _is_usable(wave: _Wave) -> bool:
    known = math.isfinite(wave.amplitude) and math.isfinite(wave.period) and math.isfinite(wave.direction)
    return known and wave.amplitude > 0.0 and wave.period > 0.0


def _significant_height(phillips: float, peakedness: float, period: float, gravity: float) -> float:
    """Return Hs of a Jonswap spectrum (Hasselmann and others 1973) with a Phillips constant."""
    ratio = np.linspace(0.3, 8.0, 4000)
    width = np.where(ratio <= 1.0, 0.07, 0.09)
    with np.errstate(all="ignore"):  # of values out of range, which a check reports
        shape = ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * peakedness ** np.exp(-0.5 * ((ratio - 1.0) / width) ** 2)
    squared = period / (2.0 * math.pi) * (period / (2.0 * math.pi))
    area = phillips * float(shape.sum()) * float(ratio[1] - ratio[0])
    return 4.0 * gravity * squared * math.sqrt(max(area, 0.0))


def _moved(scene: ResolvedDeck, wave: _Wave, vessel: str, direction: Floats) -> TopMotion:
    """Return the motion by the operators of a vessel; without operators a heave of half of the amplitude."""
    line, height = scene.line_of(wave.where), 2.0 * wave.amplitude
    for rows, heading, source in _operators_of(scene, vessel):
        six = _responses(rows, wave.direction - heading, wave.period)
        if six is not None:
            angle = math.radians(heading)
            along = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
            surge = wave.amplitude * (six[1] * float(along[0] @ direction) + six[2] * float(along[1] @ direction))
            words = f"by {source}, {wave.height} {height:.4g}"
            return TopMotion(wave.amplitude * six[0], surge, wave.period, words, line)
    return TopMotion(0.5 * wave.amplitude, 0.0, wave.period, f"{wave.height}/4, assumed", line)


def _operators_of(scene: ResolvedDeck, vessel: str) -> Iterator[tuple[list[list[float]], float, str]]:
    """Yield operators of a vessel, its heading, and their source; files that cannot be read are passed over."""
    heading, files = 0.0, list[tuple[Where, str | None, str | None, str | None]]()
    placed = chain.from_iterable(map(scene.deck.blocks, catalogue.definers(Names.VESSEL)))
    for where, each in ((where, each) for where, block in placed for each in block.vessels):
        if folded(str(each.vessel)) == folded(vessel):
            heading = number(each.position, "yaw", 0.0)
            files.append((where, getattr(each, "rao", None), getattr(each, "format", None), None))
    for where, block in scene.deck.blocks("RAO", "LOAD CASE"):
        for entry in cast("Raos", block).vessels:
            if folded(str(entry.vessel)) == folded(vessel):
                files.append((where, entry.file, entry.format, entry.layout))
                if (given := _written(entry)) and np.isfinite(given).all():
                    yield given, heading, "*RAO"
    for where, name, form, layout in files:
        path = find_file(scene.deck.folder_of(where), name) if name and (form or "MCS").upper() == "MCS" else None
        with suppress(OSError, ValueError):  # a fault of the file is a finding of its own
            if path is not None:
                yield operators(path, layout or ""), heading, path.name


def _written(entry: VesselRao) -> list[list[float]]:
    """Return the operators in the deck itself, in the form in which `operators` returns those of a file."""
    if entry.lines is not None:
        found: list[list[float]] = np.column_stack([entry.lines.column(at) for at in range(14)]).tolist()
        return found
    return [
        [
            number(each, "heading"),
            number(one, "frequency"),
            *(number(part, motion, 0.0) for motion in _MOTIONS for part in (one.amplitudes, one.phases)),
        ]
        for each in entry.headings
        for one in each.frequencies
    ]


def _responses(rows: list[list[float]], heading: float, period: float) -> list[complex] | None:
    """Return heave, surge and sway in a wave of amplitude 1 from a heading; None outside the operators' frequencies.

    * Between headings and frequencies they are linear.
    * If all headings lie on one side, they are mirrored to the other side.
    * Frequencies are radians per second, or cycles per second if only these reach the wave.
    """
    values = np.array(rows)
    phasors = values[:, 2:8:2] * np.exp(-1j * np.radians(values[:, 3:9:2]))
    angle = (heading + _HALF_TURN) % _WHOLE_TURN - _HALF_TURN
    headings, frequencies = np.unique(values[:, 0]), np.unique(values[:, 1])
    side = 1.0
    if len(headings) > 1 and angle < 0.0 and headings[0] >= 0.0:
        angle, side = -angle, -1.0
    angle = float(np.clip(angle, headings[0], headings[-1]))
    omega = 2.0 * math.pi / period
    wanted = next((each for each in (omega, 1.0 / period) if frequencies[0] <= each <= frequencies[-1]), None)
    if wanted is None:
        return None
    found = []
    for motion in range(3):
        of_headings = []
        for each in headings:
            own = values[:, 0] == each
            order = np.argsort(values[own, 1])
            x, y = values[own, 1][order], phasors[own, motion][order]
            of_headings.append(np.interp(wanted, x, y.real) + 1j * np.interp(wanted, x, y.imag))
        y = np.array(of_headings)
        found.append(complex(np.interp(angle, headings, y.real), np.interp(angle, headings, y.imag)))
    return [found[0], found[1], side * found[2]]


def in_words(value: complex, unit: str) -> str:
    """Return an amplitude with its unit, and the degrees by which it lags, if it does."""
    lag = -math.degrees(cmath.phase(value)) if value else 0.0
    return f"{abs(value):.3g}{unit}" + (f" at {lag:.0f} deg" if abs(lag) >= 1.0 else "")


# ----------------------------------------------------------------------------------------------------------------- time


class OwnSteps(NamedTuple):
    """Time steps of a deck: the largest, the first of a variable one, and the place."""

    largest: float
    first: float
    where: Where


def own_steps(scene: ResolvedDeck) -> OwnSteps | None:
    """Return the steps of the last `*TIME`; None without one."""
    found = None
    for where, block in scene.deck.blocks("TIME", "LOAD CASE"):
        span = cast("TimeSpan", block)
        step = number(span.fixed, "increment")
        if step > 0.0 and math.isfinite(step):
            found = OwnSteps(step, step, where.inside("fixed", "increment"))
        for index, limits in enumerate(span.limits or ()):
            largest, first = number(limits, "largest"), number(limits, "suggested")
            if largest > 0.0 and first > 0.0 and math.isfinite(largest + first):
                found = OwnSteps(largest, first, where.inside("limits", index, "largest"))
    return found


class Scheme(NamedTuple):
    """Time integration scheme: M [(1 - am) a1 + am a0] + (1 - af) R1 + af R0 = 0 with Newmark's gamma and beta.

    name: "generalised-alpha" or "hilber-hughes".
    alpha_m, alpha_f: am and af.
    rho, alpha: the parameter of each scheme, None for the other scheme.
    """

    name: str
    alpha_m: float
    alpha_f: float
    rho: float | None = None
    alpha: float | None = None

    @property
    def radius(self) -> float:
        """Spectral radius at infinite frequency."""
        share = self.alpha_f if self.alpha is None else 0.5 * (1.0 + self.alpha)
        return share / (1.0 - share)

    @property
    def gamma(self) -> float:
        """Newmark's gamma of second order."""
        return 0.5 - self.alpha_m + self.alpha_f

    @property
    def beta(self) -> float:
        """Newmark's beta of the least dissipation at low frequencies."""
        return 0.25 * (1.0 - self.alpha_m + self.alpha_f) ** 2


def generalised_alpha(rho: float) -> Scheme:
    """Return generalised-alpha (Chung and Hulbert 1993) with the spectral radius `rho` at infinity."""
    return Scheme("generalised-alpha", (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0), rho=rho)


def hilber_hughes(alpha: float) -> Scheme:
    """Return the scheme of Hilber, Hughes and Taylor (1977), `alpha` from -1/3 to 0."""
    return Scheme("hilber-hughes", 0.0, -alpha, alpha=alpha)


_DEFAULT_RHO, _DEFAULT_HUGHES = 0.4, -0.25


def scheme_of(scene: ResolvedDeck) -> tuple[Scheme, int]:
    """Return the scheme of the last `*TIME STEPPING`, or the program's default, and its line, 0 for none."""
    scheme, line = generalised_alpha(_DEFAULT_RHO), 0
    for where, block in scene.deck.blocks("TIME STEPPING", "LOAD CASE"):
        stepping, line = cast("TimeStepping", block), scene.line_of(where)
        if stepping.type_ == "HILBER-HUGHES":
            scheme = hilber_hughes(max(number(stepping.hilber_hughes, "coefficient", _DEFAULT_HUGHES), -1.0 / 3.0))
        elif stepping.alphas is not None:
            default = generalised_alpha(_DEFAULT_RHO)
            alpha_m = number(stepping.alphas, "alpha_m", default.alpha_m)
            alpha_f = number(stepping.alphas, "alpha_f", default.alpha_f)
            scheme = Scheme("generalised-alpha", alpha_m, alpha_f)
        else:
            scheme = generalised_alpha(number(stepping, "infinity", _DEFAULT_RHO))
    return scheme, line
