"""Values that belong to another system of units: gravity, stiffness, densities, moduli, lengths."""

from __future__ import annotations

from mudline.linting.rules.units import densities, lengths, magnitudes, moduli

__all__ = ["densities", "lengths", "magnitudes", "moduli"]
