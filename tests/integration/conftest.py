"""Recipes for shells are tried where the system is of the Unix kind."""

from __future__ import annotations

import os

collect_ignore = [] if os.name == "posix" else ["test_action_steps.py", "test_ci_page.py", "test_completion_in_bash.py"]
