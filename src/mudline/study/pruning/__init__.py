"""What each feature of a scene costs, and that a scene does not pay for those it has not."""

from __future__ import annotations

from mudline.study.pruning.running import run

__all__ = ["run"]
