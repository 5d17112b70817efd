"""The index of the catalogue, made of the declarations in the library. `make index` writes it, a test holds it."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import get_args

from mudline.language.keywords import catalogue, library
from mudline.language.keywords.naming import Role, kinds_of
from mudline.language.keywords.values import SUBJECTS, Entry

_WIDE = 115
INDEX = Path("src/mudline/language/keywords/index.py")

ROLES: tuple[Role, ...] = get_args(Role)

_PAGE = '''\
"""Every declaration of the library; `make index` makes this of them: change those."""

# fmt: off
from __future__ import annotations

from mudline.language.keywords.values import Entry

ENTRIES: tuple[Entry, ...] = (
{lines}
)
'''


def declared_entries() -> list[Entry]:
    """An entry for each declaration, in the order of the catalogue: by subject, section and name."""
    found = [entry for module in iter_modules(library.__path__) for entry in _entries(module.name)]
    places = {name: number for number, name in enumerate(catalogue.SECTIONS)}
    return sorted(found, key=lambda entry: (SUBJECTS.index(entry.subject), places[entry.sections[0]], entry.keyword))


def _entries(module: str) -> list[Entry]:
    declared = import_module(f"{library.__name__}.{module}")
    found: list[Entry] = []
    if hasattr(declared, "BLOCK"):
        block = catalogue.load(module)
        keyword = block.model_fields["keyword"].default
        names, defines = (tuple(sorted(kind.name for kind in kinds_of(block, role))) for role in ROLES)
        short, telling = block.facts.zero_length, block.facts.telling
        found.append(
            Entry(
                *(keyword, module, block.sections, block.subject),
                zero_length=short,
                names=names,
                defines=defines,
                telling=telling,
            )
        )
    if hasattr(declared, "OPAQUE"):
        kept = catalogue.load_opaque(module)
        keyword = kept.keyword
        inferred, short = kept.sections_inferred, kept.zero_length
        found.append(
            Entry(
                keyword, module, kept.sections, kept.subject, kept=True, sections_inferred=inferred, zero_length=short
            )
        )
    return found


def index_text() -> str:
    """The whole file."""
    return _PAGE.format(lines="\n".join(f"    {_written(entry)}," for entry in declared_entries()))


def _written(entry: Entry) -> str:
    given = [
        f"{name}={value!r}" if name in Entry._field_defaults else repr(value)
        for name, value in entry._asdict().items()
        if value != Entry._field_defaults.get(name)
    ]
    line = f"Entry({', '.join(given)})"
    if len(line) > _WIDE:
        line = "Entry(\n" + "".join(f"        {each},\n" for each in given) + "    )"
    return line.replace("'", '"')


if __name__ == "__main__":
    INDEX.write_text(index_text(), encoding="utf-8", newline="\n")
