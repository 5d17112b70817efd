"""Decks on several machines: a scheduler of dask with its workers, and decks and results at URLs.

`scheduler` connects to a cluster or starts one, `running` sends chunks of decks to its workers, which leave files of
results, and hands the results back in their order, `storage` reads and writes files and URLs. Needs the extra
`cluster`.
"""

from __future__ import annotations
