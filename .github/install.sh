#!/usr/bin/env bash
# Installs mudline for action.yml: MUDLINE_VERSION from the package index, or the checkout of the action.
set -euo pipefail

# Python, and those that it starts, import nothing from the checkout, which may be a stranger's.
export PYTHONSAFEPATH=1

what="${GITHUB_ACTION_PATH:-.}"
if [ -n "${MUDLINE_VERSION:-}" ]; then
  what="mudline==$MUDLINE_VERSION"
fi
"${MUDLINE_PYTHON:-python}" -P -m pip install --quiet --disable-pip-version-check "$what"
