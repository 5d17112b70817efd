"""The index of the catalogue, made of the declarations in the library. `make index` writes it, a test holds it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from mudline.language.keywords import catalogue, library
from mudline.language.keywords.contents import ROLES, kinds_of
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import SUBJECTS, Entry, OpaqueKeyword

INDEX = Path("src/mudline/language/keywords/index.json")


def declared_entries() -> list[Entry]:
    """An entry for each declaration, in the order of the catalogue: by subject, section and name."""
    found = [entry for module in iter_modules(library.__path__) for entry in _entries(module.name)]
    places = {name: number for number, name in enumerate(catalogue.SECTIONS)}
    return sorted(found, key=lambda entry: (SUBJECTS.index(entry.subject), places[entry.sections[0]], entry.keyword))


def _entries(module: str) -> Iterator[Entry]:
    for name, found in vars(import_module(f"{library.__name__}.{module}")).items():
        if isinstance(found, type) and issubclass(found, Block):
            keyword = found.model_fields["keyword"].default
            if not isinstance(keyword, str):  # a base of others
                continue
            names, defines = (tuple(sorted(kind.name for kind in kinds_of(found, role))) for role in ROLES)
            yield Entry(
                *(keyword, module, name, found.sections, found.subject),
                zero_length=found.facts.zero_length,
                names=names,
                defines=defines,
                telling=found.facts.telling,
            )
        elif isinstance(found, OpaqueKeyword):
            yield Entry(
                *(found.keyword, module, name, found.sections, found.subject),
                kept=True,
                sections_inferred=found.sections_inferred,
                zero_length=found.zero_length,
            )


def index_text() -> str:
    """The whole file: a line for each entry."""
    return "[\n" + ",\n".join(map(_written, declared_entries())) + "\n]\n"


def _written(entry: Entry) -> str:
    """An entry without what has its default."""
    given = {name: value for name, value in entry._asdict().items() if value != Entry._field_defaults.get(name)}
    return json.dumps(given)


if __name__ == "__main__":
    from tests.language.keywords.stubs import stubs

    INDEX.write_text(index_text(), encoding="utf-8", newline="\n")
    for path, text in stubs().items():
        path.write_text(text, encoding="utf-8", newline="\n")
