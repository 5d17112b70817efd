"""The seabed: what carries the elements, what is given twice or for nothing, where the nodes lie."""
