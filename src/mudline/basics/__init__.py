"""What every layer uses and what knows no deck: files, limits, numbers and names as they are shown, arguments."""
