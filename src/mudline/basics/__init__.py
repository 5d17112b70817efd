"""Basics that every layer uses and that know no deck: files, limits, display of numbers and names, arguments."""
