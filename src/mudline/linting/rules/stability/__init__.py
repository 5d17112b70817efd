"""What keeps a solution from being found, or from being right."""
