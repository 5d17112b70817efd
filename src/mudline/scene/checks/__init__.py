"""What makes a deck illegal, doubtful, or impossible to evaluate: checks of a resolved deck, a module for each subject.

What reading and resolving notice on their way needs no function and is declared in `mudline.codes`.
All modules in here are imported.
"""
