"""Rules over a deck and its scene, and the formats of their findings."""
