"""Studies of the numbers: how exact, how stable and how costly they are, on a deck of the user's or a built-in one.

Each study is a package with `run(scene, options)`, which returns a `StudyReport`; scipy, mpmath and matplotlib are
needed by some of them and come with the extra `mudline[study]`.
"""
