"""The units of a deck in SI, and defaults that are fixed in SI; user units have neither."""

from __future__ import annotations

FOOT = 0.3048
POUND = 4.4482216152605

LENGTH_UNIT = {"metric": 1.0, "imperial": FOOT}
FORCE_UNIT = {"metric": 1.0, "imperial": POUND}

DEFAULT_DENSITY = {"metric": 1025.0, "imperial": 1025.0 * FOOT**4 / POUND}
DEFAULT_GRAVITY = {"metric": 9.81, "imperial": 9.81 / FOOT}
LARGEST_MOBILISATION = {"metric": 3.048, "imperial": 10.0}
"""Largest mobilisation length where none is given: 10 ft."""
