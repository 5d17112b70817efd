"""The numbers that a deck describes: curves, contact with the seabed, the scene and its results."""
