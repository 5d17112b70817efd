"""Recovery from faults, for findings alone: each module corrects the faults of one subject."""
