"""Decks as people write them: every keyword with a model, opaque ones, comments and blank lines anywhere."""

from __future__ import annotations

from hypothesis import strategies as st

from mudline.keywords.text import cut_number
from tests.builders.spellings import (
    cased,
    comments,
    equations,
    gaps,
    idents,
    names,
    no_head,
    numbers,
    reals,
    rows,
    setting,
    texts,
    whole_fields,
)

Lines = list[str]


@st.composite
def padded(draw: st.DrawFn, required: int, most: int, hollow: int = 0) -> list[str]:
    """`required` to `most` reals; those before index `hollow`, and those not required, may be empty."""
    count = draw(st.integers(required, most))
    fields = [draw(reals) if hollow <= i < required else draw(st.one_of(reals, st.just(""))) for i in range(count)]
    return fields or [""]


@st.composite
def units(draw: st.DrawFn) -> Lines:
    return [draw(setting("UNITS", draw(cased(draw(st.sampled_from(["METRIC", "IMPERIAL"]))))))]


@st.composite
def parameters(draw: st.DrawFn) -> Lines:
    lists = st.sampled_from(["/X:11, Y:22 Z:=[a/b]/", "/1 2 3/", "//", '/"a, b", 2/', "/a;1, b;2/"])
    values = st.one_of(numbers, equations, lists, names)
    pairs = draw(st.lists(st.tuples(names, values), max_size=4))
    return [" " + draw(rows([name, value])) for name, value in pairs]


@st.composite
def variation(draw: st.DrawFn) -> Lines:
    lines: Lines = []
    for name in draw(st.lists(names, max_size=3)):
        lines.append(draw(setting("NAME", name)))
        for _ in range(draw(st.integers(0, 3))):
            values = ", ".join(draw(st.lists(st.one_of(names, numbers, equations), min_size=1, max_size=3)))
            span = ", ".join(draw(st.lists(reals, min_size=2, max_size=3)))
            chosen = [
                ("PARA", f"{draw(names)}, VALUE = {values}"),
                ("PARA", f"{draw(names)}, Gen={span}"),
                ("ACTION", f"{draw(cased('ADD'))}, KEYWORD={draw(names)}, FILE={draw(names)}, SECTION={draw(names)}"),
                ("ACTION", "REMOVE, KEYWORD=VESSEL,INTEGRATED"),
            ]
            lines.append(draw(setting(*draw(st.sampled_from(chosen)))))
    return lines


@st.composite
def combinations(draw: st.DrawFn) -> Lines:
    lines = [draw(setting("DIRECTORY", draw(names)))] if draw(st.booleans()) else []
    for text in draw(st.lists(names, max_size=3)):
        folder = f", SUBDIRECTORY={draw(names)} %{draw(names)}%" if draw(st.booleans()) else ""
        file = f", FileName=%{draw(names)}%s" if draw(st.booleans()) else ""
        lines.append(draw(setting("DESCRIPTION", f"{text}{folder}{file}")))
        for called in draw(st.lists(st.lists(names, min_size=1, max_size=3), max_size=2)):
            lines += [draw(setting("VARIATIONS", ", ".join(called)))]
    return lines


@st.composite
def ocean(draw: st.DrawFn) -> Lines:
    return [draw(rows(draw(padded(1, 4)), spare=True))]


@st.composite
def nodes(draw: st.DrawFn) -> Lines:
    row = st.builds(lambda node, xyz: [node, *xyz], whole_fields, padded(2, 3)).flatmap(lambda f: rows(f, spare=True))
    step = st.lists(whole_fields, min_size=2, max_size=3).map(", ".join).flatmap(lambda value: setting("GEN", value))
    return draw(st.lists(st.one_of(row, row, row, step), max_size=6))


@st.composite
def elements(draw: st.DrawFn) -> Lines:
    ends = st.tuples(idents, idents)
    row = st.builds(lambda element, two, v: [element, *two, *v], whole_fields, ends, padded(0, 6)).flatmap(rows)
    step = st.lists(whole_fields, min_size=2, max_size=3).map(", ".join).flatmap(lambda value: setting("GEN", value))
    return draw(st.lists(st.one_of(row, row, step), max_size=5))


@st.composite
def element_sets(draw: st.DrawFn) -> Lines:
    row = st.lists(idents, min_size=1, max_size=5).flatmap(lambda fields: rows(fields, spare=True))
    step = st.lists(whole_fields, min_size=2, max_size=3).map(", ".join).flatmap(lambda value: setting("GEN", value))
    subset = names.flatmap(lambda name: setting("SUBSET", name))
    lines: Lines = []
    for name in draw(st.lists(names, max_size=3)):
        lines += [draw(setting("SET", name)), *draw(st.lists(st.one_of(row, step, subset), max_size=3))]
    return lines


@st.composite
def line_sections(draw: st.DrawFn, most: int, *, mesh: bool) -> Lines:
    """Lines of SECTION= with up to `most` distances, each with what stands below it."""
    lines: Lines = []
    for name in draw(st.lists(names, max_size=3)):
        distances = draw(st.lists(reals, min_size=1, max_size=most))
        group = [f"Repeat = {draw(names)}"] if not mesh and draw(st.booleans()) else []
        lines.append(draw(setting("SECTION", ", ".join([name, *distances, *group]))))
        for _ in range(draw(st.integers(0, 2))):
            lines.append(draw(setting("ADDITIONAL", ", ".join(draw(st.lists(names, min_size=1, max_size=3))))))
        if mesh and draw(st.booleans()):
            lines.append(draw(rows(draw(padded(0, 3)), spare=True)))
    return lines


@st.composite
def line_section_groups(draw: st.DrawFn) -> Lines:
    groups = draw(st.lists(names, max_size=2))
    return [line for name in groups for line in (draw(setting("NAME", name)), *draw(line_sections(1, mesh=True)))]


@st.composite
def line_path_sections(draw: st.DrawFn) -> Lines:
    paths = draw(st.lists(names, max_size=2))
    return [line for name in paths for line in (draw(setting("LINE", name)), *draw(line_sections(2, mesh=False)))]


_FORMATS = {"FLEXIBLE": (9, 11, 4), "RIGID": (5, 11, 1), "MOORING": (3, 5, 0), "TRUSS": (3, 7, 1)}
_INLINE = ("EIYY", "EIZZ", "GJ", "EA", "EI", "EI_HYSTERESIS", "E", "PLASTIC HARDENING")


@st.composite
def geometric_sets(draw: st.DrawFn) -> Lines:
    lines: Lines = []
    option = "FLEXIBLE"
    for name in draw(st.lists(names, max_size=3)):
        if draw(st.booleans()):
            option = draw(st.sampled_from(sorted(_FORMATS)))
            lines.append(draw(setting("OPTION", draw(cased(option)))))
        inline = [f"{key}={draw(names)}" for key in draw(st.lists(st.sampled_from(_INLINE), unique=True, max_size=2))]
        buoyancy = ["Buoyancy = Distributed"] if draw(st.booleans()) else []
        lines.append(draw(setting("SET", ", ".join([name, *buoyancy, *inline]))))
        lines.append(draw(rows(draw(padded(*_FORMATS[option])))))
        if draw(st.integers(0, 3)) == 0:
            lines.append(draw(setting("COMPRESSION CHECK", draw(names))))
    return lines


@st.composite
def seabed_properties(draw: st.DrawFn) -> Lines:
    lines: Lines = []
    if draw(st.booleans()):
        lines.append(draw(setting("TYPE", draw(cased(draw(st.sampled_from(["RIGID", "ELASTIC"])))))))
    for name in draw(st.lists(names, max_size=3)):
        group = [
            ("STIFFNESS", draw(st.one_of(reals, names))),
            ("FRICTION", ", ".join(draw(padded(0, 7)))),
            ("LATERAL", draw(reals)),
            ("SUCTION", ", ".join(draw(padded(1, 2)))),
        ]
        chosen = draw(st.lists(st.sampled_from(group), unique_by=lambda pair: pair[0], max_size=4))
        lines += [draw(setting("SET", name)), *(draw(setting(*pair)) for pair in chosen)]
    return lines


_points = st.lists(st.tuples(reals, reals).flatmap(lambda point: rows(list(point), spare=True)), max_size=5)


@st.composite
def seabed_stiffness(draw: st.DrawFn) -> Lines:
    return [
        line for name in draw(st.lists(names, max_size=3)) for line in (draw(setting("CURVE", name)), *draw(_points))
    ]


@st.composite
def embedment(draw: st.DrawFn) -> Lines:
    lines = draw(_points) if draw(st.booleans()) else []
    return lines + [
        line for name in draw(st.lists(names, max_size=2)) for line in (draw(setting("SET", name)), *draw(_points))
    ]


@st.composite
def surface(draw: st.DrawFn, most: int) -> Lines:
    fields = draw(padded(0, most))
    lines = [draw(rows(fields))]
    if not lines[0].strip():
        lines = [" ,"]
    if draw(st.booleans()):
        return lines + ([draw(rows([draw(reals)]))] if draw(st.booleans()) else [])
    return lines + [draw(rows([draw(reals), draw(reals)])) for _ in range(draw(st.integers(0, 3)))]


_OPAQUE = {
    "MODEL": ("HYDRODYNAMIC SETS", "NODE, CURVILINEAR", "LINES", "pip section", "TITLE", "NEW THING", "Gel\u00e4nde"),
    "PREPROCESSOR": ("EXCEL VARIATIONS", "TITLE"),
    "ANALYSIS": ("ANALYSIS TYPE", "NEW THING"),
    "LOAD CASE": ("OFFSET", "TIME,DISCONNECT", "WAVE-REGULAR", ""),
}


@st.composite
def opaque(draw: st.DrawFn) -> Lines:
    return [no_head(line) for line in draw(st.lists(texts, max_size=4))]


MODELLED: dict[str, tuple[str, st.SearchStrategy[Lines]]] = {
    "UNITS": ("ANALYSIS", units()),
    "PARAMETERS": ("PREPROCESSOR", parameters()),
    "VARIATION": ("PREPROCESSOR", variation()),
    "COMBINATIONS": ("PREPROCESSOR", combinations()),
    "OCEAN": ("MODEL", ocean()),
    "NODE": ("MODEL", nodes()),
    "ELEMENT": ("MODEL", elements()),
    "ELEMENT SETS": ("MODEL", element_sets()),
    "LINE SECTION GROUPS": ("MODEL", line_section_groups()),
    "LINE PATH SECTIONS": ("MODEL", line_path_sections()),
    "GEOMETRIC SETS": ("MODEL", geometric_sets()),
    "SEABED PROPERTIES": ("MODEL", seabed_properties()),
    "SEABED STIFFNESS": ("MODEL", seabed_stiffness()),
    "EMBEDMENT": ("MODEL", embedment()),
    "ELASTIC SURFACE": ("MODEL", surface(11)),
    "RIGID SURFACE": ("MODEL", surface(7)),
}
"""Every keyword with a model: its section and its lines."""


@st.composite
def remarked(draw: st.DrawFn, lines: Lines) -> Lines:
    """Lines with comments and blank lines put in."""
    remarks = st.one_of(comments, comments, gaps)
    for at in sorted(draw(st.lists(st.integers(0, len(lines)), max_size=3)), reverse=True):
        lines = [*lines[:at], draw(remarks), *lines[at:]]
    return lines


@st.composite
def blocks(draw: st.DrawFn, section: str) -> Lines:
    known = [keyword for keyword, (belongs, _) in MODELLED.items() if belongs == section]
    keyword = draw(st.sampled_from([*known, *known, *known, *_OPAQUE[section]]))
    lines = draw(MODELLED[keyword][1] if keyword in known else opaque())
    return [f"*{draw(cased(keyword))}", *draw(remarked(lines))]


@st.composite
def deck_lines(draw: st.DrawFn) -> Lines:
    """The lines of a whole deck without a fault."""
    lines: Lines = draw(st.lists(st.one_of(comments, gaps), max_size=3))
    for section in draw(
        st.lists(st.sampled_from([*["MODEL"] * 6, "PREPROCESSOR", "PREPROCESSOR", "ANALYSIS", "LOAD CASE"]), max_size=3)
    ):
        lines += [f"${draw(cased(section))}", *draw(remarked([]))]
        for block in draw(st.lists(blocks(section), max_size=4)):
            lines += block
    return lines


@st.composite
def deck_texts(draw: st.DrawFn) -> str:
    """A whole deck without a fault, with line ends of any kind."""
    lines = draw(deck_lines())
    if lines and lines[-1] == "*":  # a file that was cut off
        lines.append(" x")
    ends = draw(st.sampled_from([["\n"], ["\r\n"], ["\r"], ["\n", "\r\n", "\r"]]))
    text = "".join(line + (ends[index % len(ends)]) for index, line in enumerate(lines))
    last = lines[-1].strip() if lines else ""
    whole = last.startswith("*") or cut_number(last.rpartition("=")[2])  # without its line end it would be cut off
    return text if draw(st.booleans()) or whole else text.removesuffix("\n").removesuffix("\r")


@st.composite
def mutated(draw: st.DrawFn, originals: st.SearchStrategy[bytes]) -> bytes:
    """Bytes changed, cut out and put in at a few places."""
    data = bytearray(draw(originals))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(data)))
        match draw(st.sampled_from(["flip", "cut", "insert", "end"])):
            case "flip" if at < len(data):
                data[at] ^= 1 << draw(st.integers(0, 7))
            case "cut":
                del data[at : at + draw(st.integers(1, 20))]
            case "insert":
                data[at:at] = draw(st.one_of(st.sampled_from(SHARDS), st.binary(max_size=4)))
            case _:
                del data[at:]
    return bytes(data)


SHARDS = [
    *(
        b"$",
        b"*",
        b"=[",
        b"]",
        b"{",
        b"}",
        b'"',
        b"/",
        b",",
        b"=",
        b"\r",
        b"\n",
        b"\r\n",
        b"C",
        b"C ",
        b"SET=",
        b"GEN=1,",
    ),
    *(b"nan", b"1e400", b"1,5", b"\n$MODEL\n*NODE\n", b"\n*EMBEDMENT\n", b"\nCURVE=x\n", b"\nCabc\n"),
    *(b"\xef\xbb\xbf", b"\x00"),
]
"""Pieces that mean something in a deck."""
