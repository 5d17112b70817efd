"""Friction of nodes on the bed: two directions, each a spring up to its limit; trenches raise the lateral one."""
