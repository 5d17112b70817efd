"""Resolved deck: sets expanded, diameters, lengths and laws as arrays, and the deck line behind every index."""
