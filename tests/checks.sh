#!/usr/bin/env bash
# All checks in one command: format, lint, types, generated files, tests. `-m long` runs are separate.
set -euo pipefail
cd "$(dirname "$0")/.."
ruff format --check .
ruff check .
mypy
pytest "$@"
