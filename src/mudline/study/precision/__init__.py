"""Error against run time: curve evaluation, time integration of contact, smoothing."""

from __future__ import annotations

from mudline.study.precision.running import run

__all__ = ["run"]
