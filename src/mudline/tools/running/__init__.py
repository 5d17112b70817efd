"""Many items on the processes of this machine or the workers of a Dask scheduler, and remembered results.

`executors` applies a function to items and returns the results in order. `remembered` keeps results from run to run.
Neither knows what the items are.
"""
