"""How a deck is written: blanks, tabs, case, and lines that other programs may take for something else."""
