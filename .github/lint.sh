#!/usr/bin/env bash
# Runs mudline lint for action.yml. The inputs come as variables, so that nothing in them is run as a command.
set -euo pipefail

# Python, and those that it starts, import nothing from the checkout, which may be a stranger's.
export PYTHONSAFEPATH=1

# Words are parted at blanks and lines; no pattern in them is expanded.
set -f
# shellcheck disable=SC2206
paths=(${MUDLINE_PATHS:-.})
# shellcheck disable=SC2206
options=(${MUDLINE_ARGS:-})
set +f

# A table of the findings for the page of the run.
if [ -n "${GITHUB_STEP_SUMMARY:-}" ]; then
  options=(--output-format "markdown=$GITHUB_STEP_SUMMARY" ${options[@]+"${options[@]}"})
fi

exec "${MUDLINE_PYTHON:-python}" -P -m mudline lint --output-format "${MUDLINE_FORMAT:-github}" \
  ${options[@]+"${options[@]}"} -- "${paths[@]}"
