"""Resident memory of this process: what it holds now, and the most it has held.

``getrusage`` remembers the peak of the program that started this one, as its figure outlives ``exec``; the kernel's own
of the address space does not, and can be set back (proc(5), clear_refs), so that imports are not charged. A copy of a
process maps the pages of libraries anew as it touches them; those of files are told apart for that.
"""

from __future__ import annotations

import contextlib
import sys
from pathlib import Path

SELF = Path("/proc/self")


def resident() -> float:
    """Bytes held now; the peak where the system tells no more."""
    return _status("VmRSS") or _of_usage()


def peak() -> float:
    """Most bytes held since the last ``forget_peak``, or since the start where that cannot be forgotten."""
    return _status("VmHWM") or _of_usage()


def of_files() -> float:
    """Bytes of what is held now that are pages of files, as libraries are; 0 where the system does not tell."""
    return _status("RssFile") + _status("RssShmem")


def forget_peak() -> None:
    """Begin anew from what is held now, where the system can."""
    with contextlib.suppress(OSError):
        (SELF / "clear_refs").write_text("5", encoding="ascii")


def _status(name: str) -> float:
    try:
        lines = (SELF / "status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0
    return next((1024.0 * float(line.split()[1]) for line in lines if line.startswith(f"{name}:")), 0.0)


def _of_usage() -> float:
    try:
        import resource
    except ImportError:  # Windows
        return float("nan")
    size = float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    return size if sys.platform == "darwin" else 1024.0 * size
