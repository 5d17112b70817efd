"""The deck as it was meant, for findings alone: each module corrects the faults of one subject."""
