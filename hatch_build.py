"""What the build adds to the package: the tables of its grammars, which lark would compile in each run."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class TablesHook(BuildHookInterface[Any]):
    """Write the tables beside the grammars, where an editable installation reads them too."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's signature
        """Make the tables."""
        sys.path.insert(0, str(Path(self.root, "src")))
        from mudline.language.expression.parsing import MAKES  # noqa: PLC0415 - of this source, not of an installed one
        from mudline.language.syntax.grammars import save_tables  # noqa: PLC0415 - as above

        save_tables("deck")
        save_tables("blocks")
        save_tables("expression", MAKES)
