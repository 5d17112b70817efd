"""Rules of the company standard."""
