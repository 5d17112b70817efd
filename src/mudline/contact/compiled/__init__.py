"""The steps of a scene with history as compiled loops; needs numba, the extra `mudline[fast]`.

They do what the stages do, element by element and node by node, and leave everything that is not finite to them: a step
that overflows is done again by the stages, which say what is wrong. Only `choice` may be loaded without numba.
"""
