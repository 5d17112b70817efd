"""The part of the page about other programs: the mooring chain beside MoorDyn, the bouncing beam beside Exudyn."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from tests.benchmarks.dynamics.beam import read_beam
from tests.benchmarks.dynamics.bouncing import DECK
from tests.benchmarks.dynamics.chains import CASES, PULLS, catenary, read_chain
from tests.benchmarks.dynamics.peers import HELD, PULLED, REST
from tests.benchmarks.dynamics.tables import Row, load
from tests.benchmarks.dynamics.words import mm, percent, short, table, wrapped

_STANDARD = 9.80665
"""Standard gravity, m/s2, which MoorDyn takes if none is given."""
_ENDS = ("fairlead [kN]", "anchor [kN]")

_CHAINS = """\
## The same chain in {program}

A mooring chain in three depths: line, seabed and published tensions are those of one of MoorDyn's own tests
(`quasi_static_chain`, with the lines `WD0050_Chain`, `WD0200_Chain` and `WD0600_Chain`), which allows a difference of
10 % to "quasi-static codes". The decks [`chain-050`](benchmark/chain-050.keyxm), [`-200`](benchmark/chain-200.keyxm)
and [`-600`](benchmark/chain-600.keyxm) hold the same data. mudline does not look for equilibrium; the benchmark does,
by Newton's method with the evaluator's forces and tangents on straight elastic elements. {program} finds its own by
dynamic relaxation. The third opinion is the elastic catenary with friction on a rigid seabed, in closed form (Jonkman
2007).

At rest, without friction, tensions in kN:
"""

_SINKING = """\
* mudline and MoorDyn have the same masses, springs and seabed and differ by {relaxation} at most. Gravity is given to
  MoorDyn as the deck has it, {gravity:g} m/s2: its default of {usual:g} alone would make {gravities}.
* Both differ from the catenary by up to {catenary}. It lies on a rigid seabed, while a chain of {weight:.2f} kN/m
  sinks by {sinks:.2f} m on {spring:.1f} kN/m per m; and the tension of their last element is that of its middle, half
  an element below the fairlead (an element has {element:g} m in {deepest} m).
* The published tensions differ from the catenary by up to {published}, most in {shallow} m, where 1 % of the
  fairlead's tension is {centimetres:.0f} cm of depth. How the codes behind them measured the depth is not said. The
  difference of both tensions, which the weight of the suspended line fixes, is that of a line hanging {heights} m
  less high. All are far inside the limit of their own test.

Then the fairlead is pulled away from the anchor, so far that all of the chain on the seabed slips ({pulls}). With
friction the anchor feels less. Tensions in kN; MoorDyn with its default friction, 100 s after the pull:
"""

_FRICTION = """\
* With Coulomb friction ({coefficient:g}) mudline's anchor tension is within {friction} of the catenary's, which takes
  off the whole limit of what lies on the seabed. mudline's nodes press less next to the anchor: it is held at the
  mudline, and the chain needs some length to sink in. In {shallow} m the first five nodes press with {pressing} of
  their weight.
* MoorDyn's friction is another law: a force that grows with the velocity, `FricDamp` and the coefficient times it, up
  to the Coulomb limit. With its default of 200 N s/m the anchor has the tension of a chain without friction, within
  {default}. With 3e7 N s/m, which needs a step of 0.1 ms, the anchor in 200 m has {ramp:.0f} kN at the end of the
  pull, between {smooth:.0f} without and {rough:.0f} with Coulomb friction, and {held:.0f} kN when the fairlead has
  stood still for 100 s: a law of velocity holds nothing at rest. **Friction that stays in a line at rest needs a
  spring with a stick point.**
"""

_BOUNCES = """\
## A bouncing beam in {program}

[`bouncing-beam.keyxm`](benchmark/bouncing-beam.keyxm) is a free beam of 12 m that falls, tilted, on springs of 50
kN/m below its 13 nodes and bounces for 2 s, at first its low end, then the other, with whipping between. Twice
Exudyn: with the same masses and springs, its own contact (limit stops with its own switching) and its own integrator
(Newmark); and with its own beam element (ANCF `Cable2D`: cubic, consistent mass, large rotations).

![Height of the last node over time](benchmark-bouncing.png)

Largest difference of the height of any of the 13 nodes up to a time:
"""

_BOUNCED = """\
* On the same masses and springs Exudyn meets the reference within {finest} over 2 s of bouncing, with errors that
  fall as its step does: mudline's nodal springs and the located events of the reference are right.
* The beam element differs by {cable} in 0.5 s. That is the beam, not the contact: {parts} elements with lumped masses
  have a rotary inertia that is {inertia} too large and no cubic shape. Cutting each element in two, with the springs
  where they are, leaves {refined}. After seconds of bouncing small differences are large ones, in every program:
  compare single impacts.
"""

_END = """\
## What is left out

Water (drag, added mass), large displacements of the lifted line and its axial tension: they would change all numbers,
but not which scheme follows the contact. The seabed of the benchmark is flat and its normal law linear. Suction has
no counterpart in MoorDyn or Exudyn; its independent check is the energy balance of the reference, and that all
schemes of second order converge to it.
"""


def peer_bullets(folder: Path) -> Iterator[str]:
    """What the other programs say, in short."""
    chains, bounces = load("chains", folder), load("bouncing", folder)
    close = max(_off(chains, depth, "mudline", "MoorDyn") for depth in PULLS)
    yield wrapped(
        f"* {_program(chains)} has the same static tensions within {percent(close)} in three depths;",
        f"{bounces[0]['program']} the same bouncing beam within {mm(_finest(bounces)['to 2 s [m]'])} over 2 s.",
    )


def peer_parts(folder: Path) -> Iterator[str]:
    """The text, by paragraphs and tables."""
    chains, bounces = load("chains", folder), load("bouncing", folder)
    yield _CHAINS.format(program=_program(chains))
    yield _chain_table(chains, REST, ("published", "catenary", "mudline", "MoorDyn"))
    yield _sinking(chains)
    yield _chain_table(
        chains, PULLED, ("no: catenary", "no: mudline", "FricDamp 200: MoorDyn", "yes: catenary", "yes: mudline")
    )
    yield _friction(chains, folder)
    yield _BOUNCES.format(program=bounces[0]["program"])
    heads = ("to 0.5 s [m]", "to 1 s [m]", "to 2 s [m]")
    shown = [head.replace("[m]", "[mm]") for head in heads]
    yield table(
        ["Exudyn's model", "parts of an element", "step [ms]", "compared with", *shown],
        [
            [
                row["model"],
                row["parts of an element"],
                f"{1000 * float(row['step [s]']):.3g}",
                row["compared with"],
                *((short(1000 * float(row[head])) for head in heads) if not row["failure"] else ("failed", "", "")),
            ]
            for row in bounces
        ],
    )
    cables = {row["parts of an element"]: row for row in bounces if row["model"] == "cable"}
    parts = len(read_beam(DECK).start) - 1
    yield _BOUNCED.format(
        parts=parts,
        inertia=percent(2.0 / parts**2),
        finest=mm(_finest(bounces)["to 2 s [m]"]),
        cable=mm(cables["1"]["to 0.5 s [m]"]),
        refined=mm(cables["2"]["to 0.5 s [m]"]),
    )
    yield _END


def _program(chains: list[Row]) -> str:
    return next(row["source"] for row in chains if row["source"].startswith("MoorDyn"))


def _finest(bounces: list[Row]) -> Row:
    own = [row for row in bounces if row["model"] == "masses" and row["parts of an element"] == "1"]
    return min(own, key=lambda row: float(row["step [s]"]))


def _find(chains: list[Row], depth: int, when: str, source: str, friction: str = "") -> Row:
    return next(
        row
        for row in chains
        if row["depth [m]"] == str(depth)
        and row["when"] == when
        and row["source"].startswith(source)
        and (not friction or row["friction"] == friction)
    )


def _off(chains: list[Row], depth: int, one: str, other: str) -> float:
    """The larger relative difference of both ends at rest."""
    rows = [_find(chains, depth, REST, source) for source in (one, other)]
    return max(abs(float(rows[0][end]) / float(rows[1][end]) - 1.0) for end in _ENDS)


def _chain_table(chains: list[Row], when: str, sources: tuple[str, ...]) -> str:
    rows = []
    for depth in PULLS:
        for end in _ENDS:
            cells = []
            for source in sources:
                kind, _, name = source.rpartition(": ")
                cells.append(f"{float(_find(chains, depth, _when(when, name), name, kind)[end]):.1f}")
            rows.append([f"{depth} m, {end.removesuffix(' [kN]')}", *cells])
    heads = [
        source.replace("no: ", "no friction, ").replace("yes: ", "friction, ").replace(": ", ", ") for source in sources
    ]
    return table(["", *heads], rows)


def _when(when: str, source: str) -> str:
    """MoorDyn moves while it is pulled: what is at rest is compared with what it has after the hold."""
    return HELD if when == PULLED and source == "MoorDyn" else when


def _sinking(chains: list[Row]) -> str:
    shallow, deepest = min(PULLS), max(PULLS)
    case, deep = CASES[0], read_chain(CASES[-1])
    spring = float(deep.contact.input.assigned["nodal"].parameters["stiffness"][1]) / float(deep.length[0])
    line, lower = read_chain(case), []
    low, high = (catenary(line, height, case.distance, 0.0).fairlead for height in (case.depth, case.depth + 0.01))
    steeper = 100.0 * (high / low - 1.0)
    for depth in PULLS:
        rows = [_find(chains, depth, REST, source) for source in ("published", "catenary")]
        drops = [float(row[_ENDS[0]]) - float(row[_ENDS[1]]) for row in rows]
        lower.append(depth * (1.0 - drops[0] / drops[1]))
    return _SINKING.format(
        gravity=deep.gravity,
        usual=_STANDARD,
        gravities=percent(1.0 - _STANDARD / deep.gravity),
        relaxation=percent(max(_off(chains, depth, "mudline", "MoorDyn") for depth in PULLS)),
        catenary=percent(max(_off(chains, depth, "mudline", "catenary") for depth in PULLS)),
        published=percent(max(_off(chains, depth, "published", "catenary") for depth in PULLS)),
        shallow=shallow,
        weight=deep.weight / 1e3,
        spring=spring / 1e3,
        sinks=deep.weight / spring,
        deepest=deepest,
        element=float(deep.length[0]),
        centimetres=1.0 / steeper,
        heights=f"{min(lower):.2f} to {max(lower):.2f}",
        pulls=", ".join(f"{pull:g} m in {depth} m" for depth, pull in PULLS.items()),
    )


def _friction(chains: list[Row], folder: Path) -> str:
    anchor = _ENDS[1]
    near = (row for row in load("anchor", folder) if row["depth [m]"] == str(min(PULLS)))
    shares = [f"{float(row['share of its weight']):.2f}" for row in near]

    def ratio(depth: int, one: tuple[str, str], other: tuple[str, str]) -> float:
        first, second = (_find(chains, depth, _when(PULLED, source), source, kind) for source, kind in (one, other))
        return abs(float(first[anchor]) / float(second[anchor]) - 1.0)

    return _FRICTION.format(
        coefficient=read_chain(CASES[0]).friction,
        shallow=min(PULLS),
        pressing=", ".join(shares),
        friction=percent(max(ratio(depth, ("mudline", "yes"), ("catenary", "yes")) for depth in PULLS)),
        default=percent(max(ratio(depth, ("MoorDyn", "FricDamp 200"), ("mudline", "no")) for depth in PULLS)),
        ramp=float(_find(chains, 200, PULLED, "MoorDyn", "FricDamp 3e7")[anchor]),
        held=float(_find(chains, 200, HELD, "MoorDyn", "FricDamp 3e7")[anchor]),
        smooth=float(_find(chains, 200, PULLED, "mudline", "no")[anchor]),
        rough=float(_find(chains, 200, PULLED, "mudline", "yes")[anchor]),
    )
