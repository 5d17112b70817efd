"""Version of mudline, which its tools print and write."""

from __future__ import annotations

__version__ = "0.1.0"
