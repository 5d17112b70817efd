"""One function a rule; its docstring says why, and shows a bad and a good deck. All modules in here are imported."""
