"""Legal decks whose writing or contents differ from the manual's samples, as the decks of real projects do."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

Written = tuple[str, str, bytes, dict[str, bytes]]
"""Name, suffix, content, and the files beside the deck."""


def written_otherwise(texts: Mapping[str, str]) -> list[Written]:
    """Decks in other styles, made of the texts of decks by name; and decks of `*LINES`, parameters and restarts."""
    restyled: list[tuple[str, str, Callable[[str], str]]] = [
        ("blanks-for-commas", "flowline-clay-metric", _blanks),
        ("tabs", "scr-linear-metric", lambda text: _in_numbers(text, lambda row: row.replace(", ", ",\t"))),
        ("no-indentation", "old-curves-metric", lambda text: re.sub(r"(?m)^ ", "", text)),
        ("title-lines", "flowline-clay-metric", lambda text: f"Tie-back flowline, rev C\nAs laid, empty\n{text}"),
        ("lower-case", "flowline-linear-metric", lambda text: re.sub(r"(?m)^[*$].*", lambda m: m[0].lower(), text)),
        ("windows-line-ends", "scr-clay-metric", lambda text: text.replace("\n", "\r\n")),
        ("no-last-line-end", "flowline-clay-metric", lambda text: text.rstrip("\n")),
        ("ruled-comments", "scr-clay-metric", _ruled),
        ("remarks-in-blocks", "flowline-clay-metric", _remarked),
        ("many-models", "flowline-clay-metric", lambda text: re.sub(r"(?m)^(?=\*(?:SEABED P|GEOM))", "$MODEL\n", text)),
        ("load-case-first", "scr-linear-metric", _load_case_first),
        ("seabed-first", "flowline-clay-metric", _seabed_first),
        ("imperial-blanks", "flowline-mobilisation-imperial", _blanks),
        ("imperial-tabs", "old-curves-imperial", lambda text: _in_numbers(text, lambda row: row.replace(", ", ",\t"))),
        ("aligned-columns", "scr-clay-imperial", _aligned),
        ("twenty-a-line", "flowline-linear-metric", _listed),
    ]
    decks: list[Written] = []
    for name, source, change in restyled:
        suffix = "keyxi" if source.endswith("imperial") else "keyxm"
        decks.append((name, suffix, change(texts[source]).encode(), {}))
    degrees = "C Sea water at 4 \xb0C; riser heading 30\xb0\n" + texts["scr-clay-metric"]
    decks.append(("degree-sign", "keyxm", degrees.encode("cp1252"), {}))
    return decks + _other_contents(texts)


def _in_numbers(text: str, change: Callable[[str], str]) -> str:
    """The text with its rows of numbers changed."""
    return re.sub(r"(?m)^ [-+\d].*", lambda match: change(match[0]), text)


def _blanks(text: str) -> str:
    return _in_numbers(text, lambda row: row.replace(",", " "))


def _aligned(text: str) -> str:
    return _in_numbers(text, lambda row: ",".join(f"{field.strip():>12}" for field in row.split(",")))


def _ruled(text: str) -> str:
    rule = "C" + 70 * "-"
    return re.sub(r"(?m)^\*(.*)", lambda match: f"{rule}\nC  {match[1].title()}\n{rule}\n{match[0]}", text)


def _remarked(text: str) -> str:
    return re.sub(r"(?m)^( SET=.*)", r"C\nC as in the survey of May, KP 12.4 to 12.5\n\1", text) + "C\nC end\n"


def _load_case_first(text: str) -> str:
    model, mark, cases = text.partition("$LOAD CASE")
    return mark + cases + model


def _seabed_first(text: str) -> str:
    before, seabed, after = re.split(r"(?s)(\*SEABED PROPERTIES.*?)(?=\$LOAD)", text)
    return before.replace("$MODEL\n", "$MODEL\n" + seabed) + after


def _listed(text: str) -> str:
    return text.replace(" GEN=1, 12\n", f" {', '.join(map(str, range(1, 13)))}\n", 1)


# ---------------------------------------------------------------------------------------------------------- by contents

_LINES = """\
$MODEL
*OCEAN
 300.0, 1025.0, 9.81
*LINES
 LINE=Umbilical
 SECTION=Static Section, 200.0
 SECTION=Dynamic Section, 365.6
*GEOMETRIC SETS
 OPTION=FLEXIBLE
 SET=Umbilical
 12.0E3, 12.0E3, 8.0E3, 250.0E6, 36.5, 0.12, 0.0, 0.168, 0.168, 0.168
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Static Section
 STIFFNESS=Clay
 FRICTION=0.4, 0.7
 SET=Dynamic Section
 STIFFNESS=25000.0
 FRICTION=0.3, 0.7
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.02, 154.0
 0.05, 246.0
 0.1, 352.0
 0.3, 493.0
 0.5, 594.0
$LOAD CASE
*BOUNDARY
 TYPE=CONSTANT
 {Riser Base}, 1
 {Riser Base}, 2
 {Riser Base}, 3
"""

_OLD_LINES = """\
$MODEL
*OCEAN
 1200.0, 1.9888, 32.174
*LINES
 LINE=Production SCR
 SECTION=Touchdown Zone, 900.0
 SECTION=Suspended Part, 2100.0
 ADDITIONAL=Strakes
*GEOMETRIC SETS
 OPTION=RIGID
 SET=Production SCR
 4.32E9, 1.66E9, 0.8959, 0.7758, 15.23
*ELASTIC SURFACE
 850.0, 0.35, 0.6
*EMBEDMENT
 SET=Touchdown Zone
 0.0, 0.0
 0.1, 95.0
 0.5, 170.0
"""

_PARAMETERS = """\
$PREPROCESSOR
*PARAMETERS
 Depth, 850.0
 OD, =[10.75 * 0.0254]
 WT, =[0.719*0.0254]
 su, /low:1200.0, best:2000.0, high:3200.0/
 Strength, =[su_best]
 Friction, /axial:0.40 lateral:0.75/
"""

_EQUATIONS = """\
$MODEL
*OCEAN
 =[Depth], 1025.0, 9.81
*NODE
 1, =[-0.03*OD], 0.0
 21, =[-0.03*OD], 100.0
 GEN=1, 21
*ELEMENT
 1, 1, 2
 GEN=1, 20
*ELEMENT SETS
 SET=Line
 GEN=1, 20
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, =[207.0E9/(2*(1+0.3))], =[OD], =[OD - 2*WT], 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Line
 STIFFNESS=Clay
 FRICTION==[Friction_axial], =[Friction_lateral]
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.1, =[3.4*Strength*OD]
 0.5, =[4.1*Strength*OD]
"""

_VARIED = """\
*VARIATION
 NAME=Soil
 PARA=Strength, VALUE=1200.0, 2000.0, 3200.0
*COMBINATIONS
 DIRECTORY=Soils
 DESCRIPTION=All soils, FILENAME=Flowline su %Strength%
 VARIATIONS=ALL
"""

_CONVERTED = """\
$PREPROCESSOR
*PARAMETERS
 Depth, =[CONVERT(1150, "ft", "m")]
 Offset, -25.0
"""

_DYNAMIC = """\
$LOAD CASE
*RESTART
 LAST=static, TYPE=DYNAMIC
*ANALYSIS TYPE
 TYPE=TIME DOMAIN
*TIME
 STEP=FIXED
 0.0, 120.0, 0.05, 24.0
*BOUNDARY
 TYPE=CONSTANT
 1, 2, 0.0, FIXATION=RELATIVE
 1, 3, 0.0, FIXATION=RELATIVE
*WAVE-STOKES
 6.0, 12.0, 180.0
$LOAD CASE
*CURRENT
 TYPE=PIECEWISE LINEAR
 0.0, 0.1, 180.0
 1000.0, 0.8, 180.0
"""

_PROFILE = "*SEABED PROFILE\n TYPE=2D\n INTERPOLATION={}\n FILE={}\n$LOAD CASE"


def _other_contents(texts: Mapping[str, str]) -> list[Written]:
    flowline, scr = texts["flowline-clay-metric"], texts["scr-clay-metric"].encode()
    survey = b"-10.0, 0.2\n20.0, 0.0\n60.0, -0.1\n110.0, 0.1\n"
    compiled = b"FCSBD\x00\x01\x00\x7f\xfe\x00" + bytes(range(64))
    profile = {form: flowline.replace("$LOAD CASE", _PROFILE.format(*form)) for form in _FORMS}
    converted = _CONVERTED + flowline.replace(" 350.0, 1025", " =[Depth], 1025")
    return [
        ("lines-umbilical", "keyxm", _LINES.encode(), {}),
        ("lines-old-family", "keyxi", _OLD_LINES.encode(), {}),
        ("parameters", "keyxm", (_PARAMETERS + _EQUATIONS).encode(), {}),
        ("variations", "keyxm", (_PARAMETERS + _VARIED + _EQUATIONS).encode(), {}),
        ("converted-units", "keyxm", converted.encode(), {}),
        ("restart-dynamic", "keyxm", _DYNAMIC.encode(), {"static.keyxm": scr}),
        ("survey-profile", "keyxm", profile["LINEAR", "survey.txt"].encode(), {"survey.txt": survey}),
        ("compiled-profile", "keyxm", profile["CUBIC SPLINE", "bed.fcsbd"].encode(), {"bed.fcsbd": compiled}),
    ]


_FORMS = (("LINEAR", "survey.txt"), ("CUBIC SPLINE", "bed.fcsbd"))
