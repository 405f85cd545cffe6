"""Runs commands of mbla, each in a process of its own that shares what is imported: ``python -m ....worker``.

A line of JSON on standard input holds the arguments of one command, one on standard output what became of it. A process
that a signal ends, such as a segmentation fault, costs that command alone.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
import tempfile
from typing import Any

MOST_SECONDS = 60
MOST_BYTES = 4 << 30


def _imported(drawing: bool) -> None:
    """What commands import late, once for all of them; of those that draw only where they are asked for."""
    import mbla.results.diff.comparison
    import mbla.results.diff.words
    import mbla.results.exit_status
    import mbla.results.hdf5.result_file
    import mbla.results.listing.listing
    import mbla.results.record.json_record
    import mbla.results.tables.tables
    import mbla.results.verify

    if drawing:
        import matplotlib

        matplotlib.use("Agg")
        import mbla.results.pictures.plot
        import mbla.results.report.report  # noqa: F401


def _command(arguments: list[str]) -> dict[str, Any]:
    from mbla.cli import main

    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = os.fork()
        if child == 0:
            status = 70
            try:
                os.dup2(out.fileno(), 1)
                os.dup2(err.fileno(), 2)
                resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
                resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
                signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
                status = main(arguments)
            except SystemExit as exit_:
                status = exit_.code if isinstance(exit_.code, int) else 70
            except BaseException:
                import traceback

                traceback.print_exc()
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(status)
        _, ended, used = os.wait4(child, 0)
        out.seek(0)
        err.seek(0)
        return {
            "status": os.waitstatus_to_exitcode(ended),
            "seconds": used.ru_utime + used.ru_stime,
            "mib": used.ru_maxrss >> 10,
            "out": out.read().decode("utf-8", "replace"),
            "err": err.read().decode("utf-8", "replace"),
        }


def main() -> None:
    """Until standard input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    _imported(drawing="--drawing" in sys.argv)
    for line in sys.stdin:
        answers.write(json.dumps(_command(json.loads(line))) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
