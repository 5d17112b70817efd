"""Rules about faults that make a deck illegal, doubtful, or impossible to evaluate, a module for each subject.

Faults noticed while reading and resolving need no function; their codes are in `mudline.language.codes`. All modules in
here are imported.
"""
