"""Rules that report unusual values, one rule for each code, and the joints of their consequences."""

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

    The suffix gives the units of a deck: .keyxm is in metres and newtons, gravity 9.81; .keyxi in feet and pounds,
    gravity 32.2. A deck with the gravity of the other system was saved under the wrong suffix, or only half of it
    was converted. Correct the gravity, or give the file its suffix. A difference above 2 % is reported.

    Example on ocean:
        - 500.0, 1025.0, 32.2
        + 500.0, 1025.0, 9.81

    Finds: 3:17
    """
    yield from of_code(context, UNT001)


@rule(UNT002)
def suspicious_magnitude(context: LintContext) -> Iterator[Problem]:
    """A force or stiffness of the seabed seems to be in another unit.

    Too small are:

    * a seabed stiffness below 478 N/m for each metre (10 lbf/ft for each foot), which supports no pipe;
    * lateral springs and suction below 95 N/m for each metre (2 lbf/ft for each foot), which hold no pipe;
    * a cohesion below 95 Pa (2 lbf/ft2), which is that of a fluid;
    * a curve whose largest force is below a tenth of the submerged weight of its pipe, which then lies deeper than the
      curve reaches. If the weight is not known, the limit is 10 N/m, and less for cables thinner than 0.1 m.

    Any stiffness above 2.1E11 N/m2 is stiffer than steel. Such values are usually written in kilonewtons or kips. Write
    them in newtons or pounds. Zero is accepted.

    Example on seabed:
        - STIFFNESS=50.0
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    yield from of_code(context, UNT002)


@rule(UNT003)
def large_friction(context: LintContext) -> Iterator[Problem]:
    """A friction coefficient is above 2.

    Pipes on soil have coefficients of 0.2 to 1, seldom a little more. Above 2 the field usually holds a stiffness or a
    mobilisation length: FRICTION= has another field order than *ELASTIC SURFACE, which begins with the stiffness.
    Correct the field.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=50000.0, 0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    yield from of_code(context, UNT003)


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall seems to be in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial decks.

    * Water has 900 to 2500 kg/m3, heavy brines included; 0 and the density of air are accepted. 1.025 is t/m3, and 64
      is lb/ft3. If the density looks like a depth, and the depth like a density, the two were exchanged.
    * A wall has 10 to 40 000 kg/m3, as foam is light, and the steel of a riser joint may carry the mass of all that is
      around it. 0 and powers of ten are accepted as placeholders. In a section with its own area a larger density is
      reported only if it is steel in another unit.
    * A pipe up to 2.5 m wide with the modulus of steel and without its own area has at least 7000 kg/m3.
    * In user units that *OCEAN does not reveal only the ratio is checked: steel is 7 to 8.4 times as heavy as water,
      and not 1000 times more or less than that.

    Example on ocean:
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    yield from of_code(context, UNT004)


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus seems to be in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial decks.

    * Less than 1E5 N/m2 is softer than any rubber (207 is GPa, 207000 is MPa). 0 and powers of ten are accepted as
      placeholders.
    * A steel wall (7000 kg/m3 or more) is also reported if its modulus is that of steel in kPa, psi, ksi or the unit of
      the other system.
    * E and G of a material give Poisson's ratio, E/2G - 1, from 0 to 0.5, in any units. A negative ratio, which
      exchanged moduli give, is reported. A ratio above 0.5 is reported for metals (2600 kg/m3 and 60 GPa or more).
      Composites may have any ratio.

    A section gets one finding at most. FLEXIBLE, MOORING and TRUSS sections have no modulus and get none.

    Example on pipe:
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:2
    """
    yield from of_code(context, UNT005)


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
    """A value is far outside the usual range of its field.

    The keyword's page gives the usual range of every field with its reason: a source, or mechanics. A wave of 106 m, a
    period of 1.4 s, a direction of 1800 degrees or a current of 13 m/s runs without a warning, and its results look
    plausible. The value is mostly in another unit or column, or has lost its decimal point: the message proposes an
    explanation. Correct the value. Values are compared in SI. In user units they are compared if *OCEAN reveals the
    units, or if they have no dimension.

    Example on storm:
        - 3.0, 9.0, 1800.0
        + 3.0, 9.0, 180.0

    Finds: 9:12
    """
    yield from of_code(context, UNT007)


@rule(UNT008)
def remarkable_value(context: LintContext) -> Iterator[Problem]:
    """A value is unusually large or small, but not impossible.

    Neither mechanics nor a source says that it is wrong, and it may well be intended. Most decks have other values in
    this field, as its keyword's page says. Check its unit and its decimal point once, or leave it.

    Example on storm:
          3.0, 9.0, 180.0
        |*CURRENT
        | TYPE=UNIFORM
        - 3.5, 0.0
        + 1.5, 0.0

    Finds: 12:2
    """
    yield from of_code(context, UNT008)


@joint(UNT004, UNT005, UNT006)
def water_in_another_mass(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join findings to the density of the water that causes them: in user units it reveals the units of the deck."""
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
    """Join unusual values to a nearby line that does not fit its keyword: the lines may belong to a missing keyword."""
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
