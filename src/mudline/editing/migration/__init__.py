"""The legacy seabed keywords rewritten as the new family, and the proof that the deck means the same."""
