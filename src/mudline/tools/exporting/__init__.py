"""Export of a deck's model to other programs, a report of what does not carry over, and import of their results."""
