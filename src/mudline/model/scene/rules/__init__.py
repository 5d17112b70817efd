"""Rules about what makes a deck illegal, doubtful, or impossible to evaluate, a module for each subject.

What reading and resolving notice on their way needs no function and is declared in `mudline.language.codes`.
All modules in here are imported.
"""
