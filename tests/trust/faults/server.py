"""A process that has the program imported and runs commands in copies of itself, told line by line in JSON.

It answers each command with two lines: the copy's process, and how it ended.
"""

from __future__ import annotations

import importlib
import json
import os
import resource
import signal
import sys
from pathlib import Path
from typing import Any

from mbla.cli import main
from mbla.process.signals import hear_termination
from tests.trust.faults.shim import Shim

IMPORTED = (
    "mbla.run",
    "mbla.cli.check",
    "mbla.cli.starter",
    "mbla.results.listing.summary",
    "mbla.results.pictures.plot",
    "mbla.results.report.report",
    "mbla.results.tables.tables",
    "mbla.solution.resultants.solve_convex",
    "h5py",
    "meshio",
    "clarabel",
)


def _run(command: dict[str, Any], shim: Shim | None) -> None:
    """One command, in a copy of the process; ends as ``python -m mbla`` does."""
    os.setsid()
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        descriptor = os.open(
            command[name], os.O_RDONLY if number == 0 else os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666
        )
        os.dup2(descriptor, number)
        os.close(descriptor)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    hear_termination()
    for name, most in command["limits"].items():
        limit = most + (_address_space() if name == "RLIMIT_AS" else 0)
        resource.setrlimit(getattr(resource, name), (limit, limit))
    if shim is not None:
        shim.arm(**command["fault"])
    sys.exit(main(command["arguments"]))


def _address_space() -> int:
    """What this process has of it [bytes]."""
    pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[0]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


def serve() -> None:
    """Run the commands of standard input until it ends."""
    for name in IMPORTED:
        importlib.import_module(name)
    shim = Shim() if "LD_PRELOAD" in os.environ else None
    warm, output = json.loads(sys.stdin.readline()), sys.stdout
    pid = os.fork()
    if pid == 0:
        _run(warm, None)
    os.waitpid(pid, 0)
    while line := sys.stdin.readline():
        pid = os.fork()
        if pid == 0:
            sys.stdin = Path(os.devnull).open()  # noqa: SIM115 - nothing of what is told may be read twice
            _run(json.loads(line), shim)
        print(pid, file=output, flush=True)
        _, status, used = os.wait4(pid, 0)
        counts = shim.counts() if shim is not None else {}
        answer = {"status": os.waitstatus_to_exitcode(status), "counts": counts}
        answer["processor_time"] = used.ru_utime + used.ru_stime
        print(json.dumps(answer), file=output, flush=True)


if __name__ == "__main__":
    serve()
