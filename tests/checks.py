"""All checks in one command: format, lint, types and tests, these two on all cores; options go to pytest.

::

    python tests/checks.py
    python tests/checks.py -m long -n 0
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
CHECKS = (
    ("ruff", "format", "--check", "."),
    ("ruff", "check", "."),
    ("mypy", "--num-workers", "auto"),
    ("pytest", "-rs", "-n", "auto", "--dist", "loadfile"),
)
"""mypy on all cores: on one it takes minutes; -rs: what was skipped, and why: a machine without a browser or OpenGL
tests less"""


def main() -> int:
    """Run every check to its end; 1 if one of them failed."""
    failed = []
    for check in CHECKS:
        options = sys.argv[1:] if check[0] == "pytest" else []
        sys.stderr.write(f"== {' '.join([*check, *options])}\n")
        sys.stderr.flush()
        if subprocess.run([sys.executable, "-m", *check, *options], cwd=ROOT, check=False).returncode != 0:
            failed.append(check[0])
    sys.stderr.write(f"== failed: {', '.join(failed)}\n" if failed else "== all checks passed\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
