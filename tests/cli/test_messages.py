"""What commands say where nothing can be done, and what they note beside their results: a row for each."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, LINEAR, UNUSED

NODES = "".join(f" {number}, 0, {number}\n" for number in range(100, 150))
BED = "*SEABED PROPERTIES"
FILES = {
    "bad.keyxm": BAD_NUMBER,
    "clean.keyxi": CLEAN,
    "clean.keyxm": CLEAN,
    "deck.json": '{"format": "mudline-deck/1"}',
    "dir.json/deck.keyxm": CLEAN,
    "empty.keyxm": "$MODEL\n",
    "gone.keyxm": CLEAN.replace(BED, f"*SEABED PROFILE\n TYPE=2D\n FILE=gone.dat\n{BED}"),
    "linear.keyxm": LINEAR,
    "many.keyxm": CLEAN.replace(
        " 2, -0.1, 10.0\n", "".join(f" {number}, {'xy'[number % 2]}, 10.0\n" for number in range(10, 60))
    ),
    "mean.keyxm": CLEAN.replace(" 2, -0.1, ", " 2, 0.3, "),
    "misspelt.keyxm": CLEAN.replace("PROPERTIES", "PROPERTEIS"),
    "more.keyxm": CLEAN.replace("*ELEMENT\n", f"*NODE\n{NODES}*ELEMENT\n"),
    "rigid.keyxm": CLEAN.partition(BED)[0] + "*RIGID SURFACE\n 0.0\n",
    "stiffer.keyxm": CLEAN.replace("1000.0", "1200.0"),
    "ugly.keyxm": CLEAN.replace(", ", ","),
    "unused.keyxm": UNUSED,
    "weak.keyxm": CLEAN.replace(" 0.5, 3000.0", " 0.5, 500.0").replace(" 0.0, 0.0\n", " 0.0, 1000.0\n", 1),
}
SAID = [
    ("backbone aubeny --diameter 0.3 --strength 5 --tolerance 1e-9", 2, "is not in the range 1e-05<=x<=0.1"),
    ("backbone aubeny --diameter 0.3 --strength 5 --weight 6", 2, "--weight: the model aubeny has no term of the soil"),
    ("convert clean.keyxm -o dir.json", 2, "mudline: dir.json: cannot be written: is a directory\n"),
    ("convert clean.keyxm -o out.jsn", 2, "mudline: out.jsn: unknown file format (known: .das, .json, "),
    ("convert clean.keyxm -o out.json", 0, "mudline: clean.keyxm -> out.json\n"),
    ("convert clean.keyxm", 2, "unknown format to write: give -o OUT with a suffix, or --to"),
    ("convert many.keyxm --to json", 1, "mudline: 10 more errors: mudline lint shows all\n"),
    ("curves clean.keyxi", 0, "[lbf/ft2]"),
    ("curves clean.keyxm --at 1 --weight 1 --output-format csv", 2, "CSV holds one table: give --at or --weight"),
    ("curves clean.keyxm --at 1e307", 2, "overflows"),
    ("curves clean.keyxm --weight -5", 2, "mudline: --weight is -5.0: it must be greater than 0\n"),
    ("curves linear.keyxm", 0, "mudline: linear.keyxm has no curve\n"),
    ("curves unused.keyxm --weight 0.5", 0, "curve Sand: 2 points, not used by an element with a diameter\n"),
    ("curves weak.keyxm --weight 5000", 0, "mudline: curve Clay never carries this weight\n"),
    ("diff clean.keyxm bad.keyxm", 1, "bad.keyxm:6:11: error: SYN002"),
    ("diff clean.keyxm more.keyxm", 1, "nodes\n  + 100-149: 50 nodes\n50 differences\n"),
    ("diff clean.keyxm stiffer.keyxm", 1, "curves\n  ~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n1 difference\n"),
    ("evaluate .", 2, "evaluate takes one deck: several decks and folders are for mudline batch\n"),
    ("evaluate clean.keyxm --columns node=n --positions p.npz", 2, "the arrays of p.npz have names already\n"),
    ("evaluate clean.keyxm --columns node=n", 2, "--columns is for positions from a CSV: give --positions too\n"),
    ("evaluate clean.keyxm --plan", 0, "Plan, all steps at once\n"),
    ("evaluate clean.keyxm --plot nowhere/p.svg", 2, "nowhere/p.svg: cannot be written: no such file or directory\n"),
    ("evaluate clean.keyxm --plot p.jpg", 2, "p.jpg: unknown file format: give a name ending in .png, .svg or .pdf\n"),
    ("evaluate clean.keyxm --plot-elements 1", 2, "--plot-elements is for a plot: give --plot"),
    ("evaluate clean.keyxm --positions nowhere.csv", 2, "mudline: nowhere.csv: no such file or directory\n"),
    ("evaluate clean.keyxm -o dir.json", 2, "mudline: dir.json: cannot be written: is a directory\n"),
    ("evaluate clean.keyxm -o out.txt", 2, "out.txt: unknown file format: give a name ending in "),
    ("evaluate clean.keyxm bad.keyxm", 2, "evaluate takes one deck: several decks and folders are for mudline batch\n"),
    ("evaluate gone.keyxm", 1, ": error: REF015 the file 'gone.dat'"),
    ("evaluate mean.keyxm", 0, "No element is in contact in the mean of its nodes"),
    ("evaluate misspelt.keyxm", 0, ": none of 2 elements has a seabed law, so there are no forces\n"),
    ("evaluate rigid.keyxm", 0, "are held by a rigid seabed, a constraint: its force is not known"),
    ("export clean.keyxm --to abaqus -o a", 2, "'abaqus'"),
    ("export clean.keyxm --to orcaflex", 2, "Missing option '-o'"),
    ("export clean.keyxm --to orcaflex -o -", 2, "give the name of a file"),
    ("expand clean.keyxm", 2, "no folder to write to: give -o DIR, or --dry-run"),
    ("format ugly.keyxm -q --check", 1, "would reformat: ugly.keyxm\n"),
    ("help lnit", 2, "mudline: unknown command 'lnit': did you mean lint?\n"),
    ("index - -o archive", 2, "standard input cannot be archived"),
    ("lint - --watch", 2, "mudline: --watch needs files: standard input can be read once only\n"),
    ("lint bad.keyxm clean.keyxm -v", 1, "mudline: bad.keyxm: 1 finding\nmudline: clean.keyxm: 0 findings\n"),
    ("lint bad.keyxm clean.keyxm", 1, "in 2 files.\n"),
    ("lint clean.keyxm --extend-select CRV0O2", 2, "'CRV0O2' names no rule"),
    ("lint clean.keyxm --output-format json --output-format concise", 2, "takes one form, not json, concise\n"),
    ("lint clean.keyxm --output-format json=", 2, "write a file name after json=\n"),
    ("lint clean.keyxm --output-format text=a.txt", 2, "text goes to the terminal: write concise=FILE\n"),
    ("lint clean.keyxm --output-format xml", 2, "mudline: --output-format: 'xml' is not one of text, "),
    (
        "lint clean.keyxm --watch --baseline b.json --write-baseline",
        2,
        "--write-baseline exclude each other",
    ),
    ("lint clean.keyxm --watch --diff", 2, "mudline: --watch and --diff exclude each other: give one of them\n"),
    ("lint clean.keyxm --watch --fix", 2, "mudline: --watch and --fix exclude each other: give one of them\n"),
    ("lint clean.keyxm --watch --output-format json", 2, "mudline: --watch prints text or concise, not json; "),
    ("lint gone.keyxm", 1, ": warning REF015 "),
    ("migrate clean.keyxm unused.keyxm -o c.keyxm", 2, "-o takes one deck"),
    ("migrate clean.keyxm", 0, "mudline: clean.keyxm: no legacy seabed keyword\n"),
    ("report clean.keyxm -o x.html --logo none.png", 2, "none.png"),
    ("report clean.keyxm -o x.html --sections verdict,soup", 2, "'soup' is not one of verdict, findings"),
    ("report clean.keyxm", 2, "-o OUT.html"),
    ("rules SYN0O2", 2, "'SYN0O2' names no rule: did you mean SYN0"),
    ("set OCEAN.dept=1 clean.keyxm", 2, "mudline: *OCEAN has no field 'dept': did you mean depth?\n"),
    ("set OCEAN.depth clean.keyxm", 2, "expected KEYWORD.field=value, such as TIME.step=0.05"),
    ("set OCEAN.depth=1 clean.keyxm --where 'OCEAN.dept>1'", 2, "mudline: *OCEAN has no field 'dept'"),
    ("set OCEAN.depth=1 clean.keyxm --where OCEAN.depth", 2, "expected comparisons such as OCEAN.depth > 100"),
    ("set OCEAN.depth=1 deck.json clean.keyxm", 1, "deck.json: only decks in keyword text are changed"),
    ("set TIME.step=1 clean.keyxm", 1, "1 deck: 1 without it\nmudline: no deck has TIME.step\n"),
    ("show clean.keyxi", 0, "20.008 ft long"),
    ("show clean.keyxm -o sheet.csv --output-format xlsx", 2, "sheet.csv is not xlsx"),
    ("show dir.json", 2, "is a directory: this command takes one deck\n"),
    ("show empty.keyxm --sheet", 0, "mudline: empty.keyxm: the deck has no elements to list in a sheet\n"),
    ("show nowhere.keyxm", 2, "mudline: nowhere.keyxm: no such file or directory\n"),
    ("study clean.keyxm --heave 0", 2, "--heave"),
]


@pytest.mark.parametrize(("words", "code", "said"), SAID, ids=[words for words, _, _ in SAID])
def test_a_command_says(place: Place, words: str, code: int, said: str) -> None:
    for name, text in FILES.items():
        place(text, name)
    outcome = run(*shlex.split(words))
    assert (outcome.code, said in outcome.out + outcome.err) == (code, True), outcome.out + outcome.err
    assert Path("clean.keyxm").read_text(encoding="utf-8") == CLEAN


EXTRAS = [
    ("convert book.xlsx -o out.keyxm", "excel", ".xlsx needs openpyxl"),
    ("convert bed.tif -o bed.keyxm --within 1", "bathymetry", "a seabed (geotiff) needs scipy and rasterio"),
    ("evaluate clean.keyxm -o out.xlsx", "excel", ".xlsx needs xlsxwriter"),
    ("curves clean.keyxm --plot out.png", "plot", "--plot needs matplotlib"),
    ("report clean.keyxm -o out.html", "report", "report needs jinja2 and matplotlib"),
    ("index clean.keyxm -o archive", "archive", "mudline index needs duckdb and pyarrow"),
    ("lsp", "lsp", "lsp needs pygls"),
]


@pytest.mark.parametrize(("words", "extra", "said"), EXTRAS, ids=[row[0] for row in EXTRAS])
def test_a_library_that_is_missing_is_named_with_its_extra(
    words: str, extra: str, said: str, place: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mudline.cli.streams.find_spec", lambda _: None)
    for name in ("clean.keyxm", "book.xlsx", "bed.tif"):
        place(CLEAN, name)
    outcome = run(*words.split())
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == f'mudline: {said}: python -m pip install "mudline[{extra}]"\n'
    assert sorted(path.name for path in Path.cwd().iterdir()) == ["bed.tif", "book.xlsx", "clean.keyxm"]
