"""mudline: read, check, convert and evaluate the seabed contact of riser and pipeline decks."""

__version__ = "0.1.0"
