"""Source text, the lossless tree of lines and blocks, fields and rows: how a deck is written, not what it means."""
