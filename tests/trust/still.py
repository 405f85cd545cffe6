"""Commands in a process of its own, one after the other, whose clock stands still.

::

    python -m tests.trust.still < JOB

JOB is JSON: ``umask``; ``commands``, lists of arguments; ``said``, the file that gets what they print. The locale of
the environment is set in full, as a program does that has mbla inside; the command line itself leaves it alone. Prints
the exit statuses as JSON.
"""

from __future__ import annotations

import contextlib
import json
import locale
import os
import sys
import time
from datetime import datetime, tzinfo
from pathlib import Path

INSTANT = 1_767_225_600.25
"""2026-01-01 and a quarter of a second, UTC: what the clock shows while it stands"""


class StillDate(datetime):
    """Now is always the same instant, shown in the time zone of who asks."""

    @classmethod
    def now(cls, tz: tzinfo | None = None) -> StillDate:
        """The instant; without a time zone in that of the machine, as ever."""
        return cls.fromtimestamp(INSTANT, tz)


def stop_the_clock() -> None:
    """Before mbla is imported: what is measured takes no time, and it is always the same date."""
    time.perf_counter = lambda: INSTANT
    import mbla.results.results
    import mbla.sweeps.command

    for module in (mbla.results.results, mbla.sweeps.command):
        module.datetime = StillDate  # type: ignore[attr-defined]


def main() -> None:
    """Run the commands."""
    job = json.load(sys.stdin)
    os.umask(job["umask"])
    locale.setlocale(locale.LC_ALL, "")
    stop_the_clock()
    from mbla.cli import main as command

    statuses = []
    with Path(job["said"]).open("w", encoding="utf-8") as said, contextlib.redirect_stdout(said):
        for arguments in job["commands"]:
            statuses.append(command(arguments))
            said.flush()
    sys.stdout.write(json.dumps(statuses) + "\n")


if __name__ == "__main__":
    main()
