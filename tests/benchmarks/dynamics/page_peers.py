"""The part of the page about other programs: the mooring chain beside MoorDyn, the bouncing beam beside Exudyn."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from tests.benchmarks.dynamics.beam import read_beam
from tests.benchmarks.dynamics.bouncing import DECK, END
from tests.benchmarks.dynamics.chains import (
    CASES,
    LINK,
    PULLS,
    STANDARD_GRAVITY,
    VOLUME,
    catenary,
    lies_higher,
    read_chain,
)
from tests.benchmarks.dynamics.peers import CORRECTED, HELD, HOLD, LOWERED, PULLED, REST, STEEP, STEEP_IN, USUAL
from tests.benchmarks.dynamics.tables import Row, load
from tests.benchmarks.dynamics.words import listed, mm, percent, short, table, wrapped

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
* Both differ from the catenary by up to {catenary}, for two reasons. It lies on a rigid seabed, while a chain of
  {weight:.2f} kN/m sinks by {sinks:.2f} m on {spring:.1f} kN/m per m: where it leaves the mudline it is already
  inclined, and goes on as a catenary whose lowest point is half of that below the mudline. And the tension of their
  last element is that of its middle, half an element below the fairlead (an element has {element:g} m in {deepest}
  m). With both, the *corrected* catenary, {corrected} remain.
* The published tensions differ from the catenary by up to {published}, most in {shallow} m, where 1 % of the
  fairlead's tension is {centimetres:.0f} cm of depth. **They are those of a chain that lies on its links.** The test
  calls itself a validation against OrcaFlex, and its diameter, mass and EA are those that OrcaFlex gives a studless
  chain of d = {bar:g} m: {volume:g} d, 19.9 d^2 t/m, 0.854e8 d^2 kN. Such links are {link:g} d wide, so the middle of
  the chain lies half of that above the seabed, and with its sinking the lowest point of the catenary is {lower:.2f} m
  higher. With that, and standard gravity of {usual:g} m/s2, the *lowered* catenary has all six tensions within
  {lowered}; nothing was fitted. In MoorDyn and in the decks the middle of the chain meets the seabed. All are far
  inside the limit of that test.

Then the fairlead is pulled away from the anchor, so far that all of the chain on the seabed slips ({pulls}). With
friction the anchor feels less. Tensions in kN; MoorDyn with its default friction, {hold:g} s after
the pull:
"""

_FRICTION = """\
* With Coulomb friction ({coefficient:g}) mudline's anchor tension is within {friction} of the catenary's, which takes
  off the whole limit of what lies on the seabed: {lacks} kN more than mudline's. mudline's nodes press less next to
  the anchor: it is held at the mudline, bears half an element itself, and the chain needs some length to sink in. In
  {shallow} m the five nodes behind it press with {pressing} of their weight. In {depths} m
  that makes {missing} kN of the difference.
* MoorDyn's friction is another law: a force that grows with the velocity, `FricDamp` and the coefficient times it, up
  to the Coulomb limit. With its default of {usual:g} N s/m the anchor has the tension of a chain without friction,
  within {default}. With {steep} N s/m, run with a step of {step:g} ms, the anchor in {deep} m has {ramp:.0f} kN at
  the end of the pull, between {smooth:.0f} without and {rough:.0f} with Coulomb friction, and {held:.0f} kN when the
  fairlead has stood still for {hold:g} s: a law of velocity holds nothing at rest. **Friction that stays in a line at
  rest needs a spring with a stick point.**
"""

_BOUNCES = """\
## A bouncing beam in {program}

[`bouncing-beam.keyxm`](benchmark/bouncing-beam.keyxm) is a free beam of {length:g} m that falls, tilted, on springs
of {spring:g} kN/m below its {nodes} nodes and bounces for {end:g} s, at first its low end, then the other, with
whipping between. Twice Exudyn: with the same masses and springs, its own contact (limit stops with its own switching)
and its own integrator (Newmark); and with its own beam element (ANCF `Cable2D`: cubic, consistent mass, large
rotations).

![Height of the last node over time](benchmark-bouncing.png)

Largest difference of the height of any of the {nodes} nodes up to a time:
"""

_BOUNCED = """\
* On the same masses and springs Exudyn meets the reference within {finest} over {end:g} s of bouncing, with errors
  that fall as its step does: mudline's nodal springs and the located events of the reference are right.
* The beam element differs by {cable} in 0.5 s. That is the beam, not the contact: {parts} elements with lumped masses
  have a rotary inertia that is {inertia} too large and no cubic shape. Cutting each element in two, with the springs
  where they are, leaves {refined}, in three {finer}: it falls with the square of the element's length. After seconds
  of bouncing small differences are large ones, in every program: compare single impacts.
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
        f"{bounces[0]['program']} the same bouncing beam within {mm(_finest(bounces)['to 2 s [m]'])} over {END:g} s.",
    )


def peer_parts(folder: Path) -> Iterator[str]:
    """The text, by paragraphs and tables."""
    chains, bounces = load("chains", folder), load("bouncing", folder)
    yield _CHAINS.format(program=_program(chains))
    yield _chain_table(chains, REST, ("published", LOWERED, "catenary", CORRECTED, "mudline", "MoorDyn"))
    yield _sinking(chains)
    yield _chain_table(
        chains, PULLED, ("no: catenary", "no: mudline", "FricDamp 200: MoorDyn", "yes: catenary", "yes: mudline")
    )
    yield _friction(chains, folder)
    beam = read_beam(DECK)
    yield _BOUNCES.format(
        program=bounces[0]["program"],
        length=beam.start[-1, 1],
        spring=float(beam.contact.input.assigned["nodal"].parameters["stiffness"][0]) / 1e3,
        nodes=beam.nodes,
        end=END,
    )
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
    parts = beam.nodes - 1
    yield _BOUNCED.format(
        end=END,
        parts=parts,
        inertia=percent(2.0 / parts**2),
        finest=mm(_finest(bounces)["to 2 s [m]"]),
        cable=mm(cables["1"]["to 0.5 s [m]"]),
        refined=mm(cables["2"]["to 0.5 s [m]"]),
        finer=mm(cables["3"]["to 0.5 s [m]"]),
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
    case, deep = CASES[0], read_chain(CASES[-1])
    line = read_chain(case)
    low, high = (catenary(line, height, case.distance, 0.0).fairlead for height in (case.depth, case.depth + 0.01))
    steeper = 100.0 * (high / low - 1.0)

    def worst(one: str, other: str) -> str:
        return percent(max(_off(chains, depth, one, other) for depth in PULLS))

    return _SINKING.format(
        gravity=deep.gravity,
        usual=STANDARD_GRAVITY,
        gravities=percent(1.0 - STANDARD_GRAVITY / deep.gravity),
        relaxation=worst("mudline", "MoorDyn"),
        catenary=worst("mudline", "catenary"),
        corrected=worst("mudline", CORRECTED),
        published=worst("published", "catenary"),
        lowered=worst("published", LOWERED),
        lower=lies_higher(deep),
        bar=deep.diameter / VOLUME,
        volume=VOLUME,
        link=LINK,
        shallow=min(PULLS),
        weight=deep.weight / 1e3,
        spring=deep.spring / 1e3,
        sinks=deep.sinks,
        deepest=max(PULLS),
        element=float(deep.length[0]),
        centimetres=1.0 / steeper,
        hold=HOLD,
        pulls=", ".join(f"{pull:g} m in {depth} m" for depth, pull in PULLS.items()),
    )


def _friction(chains: list[Row], folder: Path) -> str:
    anchor, near = _ENDS[1], load("anchor", folder)
    shares = [row["share of its weight"] for row in near if row["depth [m]"] == str(min(PULLS))][1:6]
    missing = {row["depth [m]"]: float(row["friction missing up to it [kN]"]) for row in near}

    def tension(depth: int, source: str, kind: str, when: str = PULLED) -> float:
        return float(_find(chains, depth, _when(when, source), source, kind)[anchor])

    def ratio(depth: int, one: tuple[str, str], other: tuple[str, str]) -> float:
        return abs(tension(depth, *one) / tension(depth, *other) - 1.0)

    def taken(depth: int, source: str) -> float:
        return tension(depth, source, "no") - tension(depth, source, "yes")

    return _FRICTION.format(
        coefficient=read_chain(CASES[0]).friction,
        shallow=min(PULLS),
        pressing=", ".join(f"{float(share):.2f}" for share in shares),
        lacks=listed(f"{taken(depth, 'catenary') - taken(depth, 'mudline'):.1f}" for depth in PULLS),
        depths=listed(map(str, PULLS)),
        missing=listed(f"{missing[str(depth)]:.1f}" for depth in PULLS),
        friction=percent(max(ratio(depth, ("mudline", "yes"), ("catenary", "yes")) for depth in PULLS)),
        usual=USUAL[1],
        default=percent(max(ratio(depth, ("MoorDyn", USUAL[0]), ("mudline", "no")) for depth in PULLS)),
        steep=f"{STEEP[1]:.0e}".replace("+0", ""),
        step=1e3 * STEEP[2],
        deep=STEEP_IN,
        hold=HOLD,
        ramp=float(_find(chains, STEEP_IN, PULLED, "MoorDyn", STEEP[0])[anchor]),
        held=tension(STEEP_IN, "MoorDyn", STEEP[0]),
        smooth=tension(STEEP_IN, "mudline", "no"),
        rough=tension(STEEP_IN, "mudline", "yes"),
    )
