"""Rules that advise, one function each, whose docstring has a bad and a good deck. All modules are imported."""
