"""Friction of nodes on the bed: two directions, each a spring up to its Coulomb limit; trenches raise the lateral one."""
