"""The ``mbla`` command, also as ``python -m mbla``."""

import sys
import warnings

from mbla.process.signals import Terminated, hear_termination, held_signals


def command() -> int:
    """Load the command line and run it; the exit status. An interruption while loading is reported as later ones."""
    _say_nothing_of_numbers()
    try:
        hear_termination()
        with held_signals():  # it gives them back when all is loaded
            from mbla import cli
    except (KeyboardInterrupt, Terminated) as error:
        return cli.failed(error, {}, as_json=cli.wants_json(sys.argv[1:]))
    return cli.main()


NUMBERS = "ignore::RuntimeWarning"
"""numpy's remarks on numbers beyond what a double holds: what diverges is given up, and answers are verified"""


def _say_nothing_of_numbers() -> None:
    """No line but those of the program, here and in its children, unless the caller asks Python for warnings."""
    if not sys.warnoptions:
        sys.warnoptions.append(NUMBERS)
        warnings.simplefilter("ignore", RuntimeWarning)


if __name__ == "__main__":
    sys.exit(command())
