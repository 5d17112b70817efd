"""Legal decks whose writing or contents differ from the manual's samples, as the decks of real projects do."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

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

_DECKS = Path(__file__).with_name("decks")
"""Decks of `*LINES`, of parameters and of a restart."""
_CONVERTED = """\
$PREPROCESSOR
*PARAMETERS
 Depth, =[CONVERT(1150, "ft", "m")]
 Offset, -25.0
"""

_PROFILE = "*SEABED PROFILE\n TYPE=2D\n INTERPOLATION={}\n FILE={}\n$LOAD CASE"


def _other_contents(texts: Mapping[str, str]) -> list[Written]:
    flowline, scr = texts["flowline-clay-metric"], texts["scr-clay-metric"].encode()
    survey = b"-10.0, 0.2\n20.0, 0.0\n60.0, -0.1\n110.0, 0.1\n"
    compiled = b"FCSBD\x00\x01\x00\x7f\xfe\x00" + bytes(range(64))
    profile = {form: flowline.replace("$LOAD CASE", _PROFILE.format(*form)) for form in _FORMS}
    converted = _CONVERTED + flowline.replace(" 350.0, 1025", " =[Depth], 1025")
    return [
        *[
            (path.stem, path.suffix[1:], path.read_bytes(), {"static.keyxm": scr} if "restart" in path.stem else {})
            for path in sorted(_DECKS.iterdir())
        ],
        ("converted-units", "keyxm", converted.encode(), {}),
        ("survey-profile", "keyxm", profile["LINEAR", "survey.txt"].encode(), {"survey.txt": survey}),
        ("compiled-profile", "keyxm", profile["CUBIC SPLINE", "bed.fcsbd"].encode(), {"bed.fcsbd": compiled}),
    ]


_FORMS = (("LINEAR", "survey.txt"), ("CUBIC SPLINE", "bed.fcsbd"))
