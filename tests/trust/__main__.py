"""Run the full checks, wherever in the tests they are, and write the table of counts into README.md beside this file.

::

    python -m tests.trust [FILE_OR_FOLDER ...]

Hours for all of them; names choose, as pytest takes them. The exit status is that of pytest.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.trust.counts import write


def main() -> int:
    """Exit status of pytest."""
    status = int(pytest.main(["-m", "trust", "-rs", *(sys.argv[1:] or [str(Path(__file__).parents[1])])]))
    write()
    return status


if __name__ == "__main__":
    sys.exit(main())
