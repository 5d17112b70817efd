"""The laws driven by compiled loops, for the extra `mudline[fast]`.

`loops` makes the loops over elements and over nodes. Each takes flags and laws, which are constants of the compiled
loop: what a scene does not have is not even compiled. A loop goes over a range of rows and all steps of a batch, writes
its part of a result, moves the states on, and returns how many values came out that are not finite.

All arrays of a result are (steps, m) for elements and (steps, n) for nodes. The numpy driver does the same operations
in the same order, so both give the same bits.
"""
