"""The model of a deck for other programs, what does not carry over to them, and what comes back from them."""
