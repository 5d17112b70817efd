"""How every property test runs: no deadline anywhere, and the same examples on every run under CI."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

# A loaded machine draws examples slowly; that says nothing about the code under test.
settings.register_profile("mudline", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("mudline-ci", settings.get_profile("mudline"), derandomize=True, print_blob=True)
settings.load_profile("mudline-ci" if os.environ.get("CI") else "mudline")
