"""Limits of this process: threads of the linear algebra libraries, and memory.

**Threads.** These libraries take every core for products that are too small for it. On a busy machine of two cores
waking them made one scalar product of 14,000 numbers last 6 ms, and a solver that does little else four times slower.
They read the variables when they are loaded, so these are set before. What can use several threads are products of
dense matrices; qdldl, SuperLU, CHOLMOD (with the BLAS that its wheels bring) and clarabel are serial.

**Memory**, while a point is solved, or a file is read by a library that sets no limit: on what can be written
(RLIMIT_DATA: heap and private mappings, Linux since 4.7; getrlimit(2)), above what the process holds before. An
allocation beyond it fails: Python then raises MemoryError, some libraries abort. Addresses that are only reserved, and
pages of files, do not count, as they do with RLIMIT_AS.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from mbla.errors import LimitError

VARIABLES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def limit_threads(number: int) -> None:
    """At most this number of threads, unless the user's own variables say otherwise; before numpy is imported."""
    for variable in VARIABLES:
        os.environ.setdefault(variable, str(number))


def without_plugins() -> None:
    """No plugins of the deck's validator: looking for them reads what every installed package says of itself."""
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


STATUS = Path("/proc/self/status")
MIB = 1 << 20
LEAST = {"RLIMIT_AS": (400 * MIB, "address space (ulimit -v)"), "RLIMIT_DATA": (256 * MIB, "data (ulimit -d)")}
"""Bytes that the program and its libraries take themselves, rounded up, by the limit that they count towards."""


def refuse_too_low_limits() -> None:
    """Raises LimitError where not even the libraries would find room; before any of them is imported.

    Without that much OpenBLAS ends the process with a status of its own or asks for memory without end, deaf to
    signals, while it is loaded, and others name what has nothing to do with memory.
    """
    if sys.platform != "linux":
        return
    import resource

    for name, (least, words) in LEAST.items():
        most, _ = resource.getrlimit(getattr(resource, name))
        if most != resource.RLIM_INFINITY and most < least:
            raise LimitError(
                "out-of-memory",
                f"out of memory: the limit of {most // MIB} MiB on {words} is below the {least // MIB} MiB that the "
                "program itself takes; raise the limit",
            )


def can_limit() -> bool:
    """Whether this system holds a process to such a limit."""
    return sys.platform == "linux" and STATUS.exists()


def written() -> float:
    """Bytes of this process that count towards the limit (VmData, proc(5))."""
    lines = STATUS.read_text(encoding="utf-8").splitlines()
    return next(1024.0 * float(line.split()[1]) for line in lines if line.startswith("VmData:"))


@contextlib.contextmanager
def limited(most: float | None) -> Iterator[None]:
    """No more than this number of bytes (of ``written``) in the block; None for no limit."""
    if most is None:
        yield
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    ends = [int(most)] + [limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY]
    resource.setrlimit(resource.RLIMIT_DATA, (min(ends), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
