"""Measure lines and branches, and list what no test runs; arguments go to pytest.

::

    python -m tests.trust.coverage [FILE_OR_FOLDER ...]

The exit status is that of pytest.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.trust.coverage.measuring import measure, report


def main() -> int:
    """Exit status of pytest."""
    with tempfile.TemporaryDirectory() as folder:
        status, covered = measure(Path(folder), sys.argv[1:])
        report(Path(folder))
    sys.stdout.write(f"{covered}\n")
    return status


if __name__ == "__main__":
    sys.exit(main())
