"""Rules that report unusual values, each those of its code, and what only follows from them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, takewhile

from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.coordinates import UNT006, height_over_depth, odd_coordinates
from mudline.checks.rules.curve_ends import curves_over_lengths
from mudline.checks.rules.unusual import CODES, UNT001, UNT002, UNT003, UNT004, UNT005, UNT007, UNT008, of_code
from mudline.language.codes.fields import SYN003
from mudline.language.codes.lines import SYN001
from mudline.language.diagnostics import Problem
from mudline.language.rules import rule
from mudline.language.syntax.rows import read_number


@rule(UNT001)
def gravity_mismatch(context: LintContext) -> Iterator[Problem]:
    """The gravity of *OCEAN does not fit the unit system of the file.

    The suffix says in which units a deck is: .keyxm in metres and newtons, gravity 9.81; .keyxi in feet and pounds,
    gravity 32.2. A deck with the gravity of the other system was saved under the wrong suffix, or only half of it was
    converted. Correct the gravity, or give the file its suffix. A difference above 2 % is reported.

    Example on ocean:
        - 500.0, 1025.0, 32.2
        + 500.0, 1025.0, 9.81

    Finds: 3:17
    """
    return of_code(context, UNT001)


@rule(UNT002)
def suspicious_magnitude(context: LintContext) -> Iterator[Problem]:
    """A force or stiffness of the seabed looks as if it were in another unit.

    A seabed of less than 478 N/m for each metre (10 lbf/ft for each foot) supports no pipe, lateral springs and suction
    of less than 95 N/m for each metre (2 lbf/ft for each foot) hold none, a cohesion of less than 95 Pa (2 lbf/ft2) is
    that of a fluid, and all that is above 2.1E11 N/m2 is stiffer than steel. The largest force of a curve is compared
    with the submerged weight of the pipe that follows it: below a tenth of that the pipe lies deeper than the curve
    reaches. Where the weight is not known, it is compared with 10 N/m, for cables thinner than 0.1 m with less. Such a
    value is usually written in kilonewtons or kips. Write it in newtons or pounds. Zero is accepted.

    Example on seabed:
        - STIFFNESS=50.0
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    return of_code(context, UNT002)


@rule(UNT003)
def large_friction(context: LintContext) -> Iterator[Problem]:
    """A friction coefficient is above 2.

    Pipes on soil have coefficients of 0.2 to 1, seldom a little more. Above 2 the field usually holds a stiffness or a
    mobilisation length: the fields of FRICTION= have another order than those of *ELASTIC SURFACE, which begin with the
    stiffness. Correct the field.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=50000.0, 0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    return of_code(context, UNT003)


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall looks as if it were in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial ones. Water has 900 to 2500 kg/m3, heavy brines
    included; 0 and the density of air are accepted. 1.025 is t/m3, 64 is lb/ft3, and a density like a depth beside a
    depth like a density means that the two were exchanged. A wall has 10 to 40 000 kg/m3, as foam is light and the
    steel of a riser joint may carry the mass of all that is around it; 0 and powers of ten are accepted as
    placeholders. More in a section with an area of its own is reported only where it is steel in another unit. A pipe
    up to 2.5 m wide with the modulus of steel and without an area of its own has 7000 kg/m3 at least. In user units
    whose *OCEAN does not tell them only the ratio is checked: steel is 7 to 8.4 times as heavy as water, and not 1000
    times more or less than that.

    Example on ocean:
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    return of_code(context, UNT004)


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus looks as if it were in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial ones. Less than 1E5 N/m2 is softer than any rubber:
    207 is GPa, 207000 is MPa; 0 and powers of ten are accepted as placeholders. A steel wall (7000 kg/m3 or more) is
    also reported where its modulus is that of steel in kPa, psi, ksi or the unit of the other system. E and G of a
    material give Poisson's ratio, E/2G - 1, from 0 to 0.5: in any units, it is reported when negative, as it is when
    the two are exchanged, and when above 0.5 for metals (2600 kg/m3 and 60 GPa or more). Composites may have any. A
    section gets one finding, and FLEXIBLE, MOORING and TRUSS sections, which have no modulus, none.

    Example on pipe:
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:2
    """
    return of_code(context, UNT005)


@rule(UNT006)
def suspicious_length(context: LintContext) -> Iterator[Problem]:
    """A length does not fit the pipe: millimetres, inches, or a wall thickness in place of a diameter.

    Reported are, each with the likely unit:

    * an external diameter above 60 m (a spar hull of 37 m is legal); one above 2 m with the wall of a steel pipe, at
      least 90 mm and a 6th to a 50th of the diameter; one of a FLEXIBLE, MOORING or TRUSS section whose mass is below
      10 % or above 30 times that of the water that it displaces (0 and powers of ten are placeholders);
    * a drag or buoyancy diameter above 25 times the external one, 11.5 times in RIGID; an external one above 8 times
      both;
    * an internal diameter below a tenth of the external one in a steel pipe up to 2.5 m wide: the wall thickness;
    * a mobilisation length above 10 diameters and above 10 ft, the usual characteristic length;
    * a force-embedment curve with three points or more whose ratios become round numbers when divided by the diameter;
    * an element over 25 times as long as each of the neighbours at its two ends, all of one section; a node that is
      so far from both of its neighbours; a node at which a line turns back, as no pipe bends; an
      element that leaves out a node at which the next one begins, and ends where the line goes on;
    * a node row with one value more than the others, which fits its neighbours if two of them are a decimal comma;
    * nodes over three times as high above the seabed as the water is deep, and over 500 m above the sea.

    In user units whose *OCEAN does not tell them only ratios are checked: masses against displaced water, bores of
    walls as dense as steel, mobilisation lengths above 100 diameters, curves, elements, and nodes above ten depths.

    Example on pipe:
        - 207.0E9, 79.6E9, 323.9, 288.9, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:19
    """
    yield from of_code(context, UNT006)
    for kind in (curves_over_lengths, odd_coordinates, height_over_depth):
        yield from kind(context)


@rule(UNT007)
def unusual_value(context: LintContext) -> Iterator[Problem]:
    """A value is far outside of what its field usually holds.

    The keyword's page says of every field what is usual, with the reason: a source, or mechanics. A wave of 106 m, a
    period of 1.4 s, a direction of 1800 degrees or a current of 13 m/s runs without a word, and its results look like
    others. The value is mostly in another unit or column, or has lost its decimal point: the message proposes what
    would explain it. Correct the value. Values are compared in SI: those of user units where *OCEAN tells which they
    are, and all that have no dimension.

    Example on storm:
        - 3.0, 9.0, 1800.0
        + 3.0, 9.0, 180.0

    Finds: 9:12
    """
    return of_code(context, UNT007)


@rule(UNT008)
def remarkable_value(context: LintContext) -> Iterator[Problem]:
    """A value is seldom so large or so small.

    Neither mechanics nor a source says that it is wrong, and it may well be meant: most decks have other values in this
    field, as its keyword's page says. Look at its unit and its decimal point once, or leave it.

    Example on storm:
          3.0, 9.0, 180.0
        |*CURRENT
        | TYPE=UNIFORM
        - 3.5, 0.0
        + 1.5, 0.0

    Finds: 12:2
    """
    return of_code(context, UNT008)


@joint(UNT004, UNT005, UNT006)
def water_in_another_mass(context: LintContext, found: Found) -> Iterator[Joined]:
    """In user units, whose are known by the density of the water: what follows from a density in another unit."""
    text = context.text
    wrong = {code: problems for code, problems in found.items() if code.startswith("UNT")}
    if text is None or len(wrong) == 1 or not text.source.name.lower().endswith((".keyx", ".keyxu")):
        return
    place = next((where.inside("density") for where, _ in context.written("OCEAN")), None)
    span = text.span(place) if place and context.deck.written(place) else None
    density = read_number(text.source.unified[slice(*span)]) if span else None
    if density is None:
        return
    everything = [*chain.from_iterable(wrong.values())]
    cause = next(one for one in everything if one.code in (UNT004, UNT005, UNT006))
    fits = density * (1000.0 if density < 10.0 else 0.001)
    message = (
        f"the density {density!r} of the water does not fit the rest of the deck, in which {fits:.6g} would: write it "
        "in the deck's unit of mass"
    )
    yield Joined(cause, [one for one in everything if one is not cause], message=message, place=span)


@joint(*CODES.values(), UNT008)
def lines_of_another_keyword(context: LintContext, found: Found) -> Iterator[Joined]:
    """What is unusual beside a line that does not fit its keyword: the lines may belong to one that is missing."""
    text = context.text
    if text is None:
        return
    unusual = [one for code in (*CODES, UNT008.code) for one in found.get(code, ())]
    by_line = {text.place(one).line: one for one in unusual}
    for cause in (*found.get(SYN001.code, ()), *found.get(SYN003.code, ())):
        first = text.place(cause).line
        end = len(text.source.line_starts) + 1
        last = end if cause.code == SYN001 else min(first + 2, end)
        below = takewhile(lambda line: text.source.line(line)[:1] not in ("*", "$"), range(first, last))
        yield Joined(cause, [by_line[line] for line in (first - 1, *below) if line in by_line])
