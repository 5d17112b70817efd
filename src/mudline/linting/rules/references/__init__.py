"""Names and numbers that one place of a deck uses and another one defines."""
