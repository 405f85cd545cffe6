"""``python -m mbla`` is the ``mbla`` command."""

import sys

from mbla.cli import main

if __name__ == "__main__":
    sys.exit(main())
