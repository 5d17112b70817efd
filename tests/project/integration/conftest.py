"""Recipes for shells are tried where the system is of the Unix kind, completion where bash is new enough for it."""

from __future__ import annotations

import os
import subprocess

from tests.helpers.processes import TIMEOUT
from tests.project.integration.recipes import BASH

collect_ignore = ["test_ci_page.py", "test_completion_in_bash.py"]
if os.name == "posix":
    asked = [BASH, "-c", "(( BASH_VERSINFO[0] * 10 + BASH_VERSINFO[1] >= 44 ))"]
    completes = subprocess.run(asked, timeout=TIMEOUT, check=False).returncode == 0
    collect_ignore = [] if completes else ["test_completion_in_bash.py"]
