"""Format, lint and types in one command: ``python tests/checks.py``; tests are ``pytest`` and ``pytest -m long``."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
CHECKS = (
    ("ruff", "format", "--check", "."),
    ("ruff", "check", "."),
    ("mypy", "--num-workers", "auto"),
)
"""mypy on all cores: on one it takes minutes"""


def main() -> int:
    """Run every check to its end; 1 if one of them failed."""
    failed = []
    for check in CHECKS:
        sys.stderr.write(f"== {' '.join(check)}\n")
        sys.stderr.flush()
        if subprocess.run([sys.executable, "-m", *check], cwd=ROOT, check=False).returncode != 0:
            failed.append(check[0])
    sys.stderr.write(f"== failed: {', '.join(failed)}\n" if failed else "== all checks passed\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
