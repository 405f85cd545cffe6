"""The library between a process and the C library: built where there is a compiler, and told what is to fail."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys
from pathlib import Path

CALLS = ("write", "sync", "rename", "open", "mkdir", "unlink")
"""kinds of calls, in the order of ``shim.c``"""


def built(folder: Path) -> Path | None:
    """The library, compiled into a folder; None where that cannot be."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or sys.platform != "linux":
        return None
    library = folder / "shim.so"
    source = Path(__file__).with_name("shim.c")
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-w", "-o", library, source, "-ldl"], check=True)
    return library


class Shim:
    """The library inside the process that was begun with it."""

    def __init__(self) -> None:
        self._library = ctypes.CDLL(os.environ["LD_PRELOAD"])
        self._library.fault_counters.restype = ctypes.POINTER(ctypes.c_long)
        self._counters = self._library.fault_counters()

    def arm(self, folder: str, call: str, number: int, error: int, stays: bool, signal: int) -> None:
        """Let the call of that number below a folder fail with an error, or bring a signal; 0 counts only."""
        kind = CALLS.index(call)
        arguments = [ctypes.c_int(kind), ctypes.c_long(number), *map(ctypes.c_int, (error, stays, signal))]
        self._library.fault_arm(folder.encode(), *arguments)

    def counts(self) -> dict[str, int]:
        """Calls of the last command by kind, and ``came``: whether the fault did."""
        return {name: int(self._counters[place]) for place, name in enumerate((*CALLS, "came"))}
