"""Many items on the processes of this machine or the workers of a Dask scheduler, and remembered results.

`executors` has work done for items and gives the results in order, `remembered` keeps results from run to run. What
the items are is not known here.
"""

from __future__ import annotations
