"""The ``mbla`` command, also as ``python -m mbla``."""

import sys

from mbla.process.signals import Terminated, hear_termination, held_signals


def command() -> int:
    """Load the command line and run it; the exit status. An interruption while loading is reported as later ones."""
    try:
        hear_termination()
        with held_signals():  # it gives them back when all is loaded
            from mbla import cli
    except (KeyboardInterrupt, Terminated) as error:
        return cli.failed(error, {}, as_json=cli.wants_json(sys.argv[1:]))
    return cli.main()


if __name__ == "__main__":
    sys.exit(command())
