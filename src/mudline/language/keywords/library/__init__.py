"""One module per keyword; each declares a BLOCK."""
