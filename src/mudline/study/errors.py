"""Why a study cannot be made."""

from __future__ import annotations


class StudyError(Exception):
    """The scene has nothing that this study could measure, or something that it cannot; the message says what."""
