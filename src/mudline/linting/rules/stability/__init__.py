"""What keeps a solution from being found, or from being right."""

from __future__ import annotations

from mudline.linting.rules.stability import jumps, steps, suction

__all__ = ["jumps", "steps", "suction"]
