"""One module per keyword: what its fields are, and the machinery that reads and writes any of them."""
