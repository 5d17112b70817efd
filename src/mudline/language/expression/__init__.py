"""Equations, `=[...]`: reading them and evaluating them, without the interpreter's own `eval`."""
