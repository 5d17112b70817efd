"""What a finding is known by from run to run."""

from __future__ import annotations

from collections import Counter
from hashlib import sha256

from mudline.diagnostics import Diagnostic


class Fingerprints:
    """Hashes of path, code and message, not of the line number; the same thing found again is counted."""

    def __init__(self) -> None:
        self._met: Counter[tuple[str, str, str]] = Counter()

    def of(self, found: Diagnostic) -> str:
        """The hash of a finding, in the order of the findings; no two of a run are equal."""
        known = (found.file, found.code, found.message)
        self._met[known] += 1
        text = "\0".join([*known, str(self._met[known])])
        return sha256(text.encode("utf-8", "backslashreplace")).hexdigest()
