"""The ``mbla`` command, also as ``python -m mbla``."""

import sys

from mbla.signals import held_signals


def command() -> int:
    """Load the command line and run it; the exit status. An interruption before it is there is told as later ones."""
    try:
        with held_signals():
            from mbla.cli import main
    except KeyboardInterrupt:
        sys.stderr.write("mbla: interrupted\n")
        return 130
    return main()


if __name__ == "__main__":
    sys.exit(command())
