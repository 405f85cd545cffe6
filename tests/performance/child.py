"""A measurement in a process of its own: on one thread, with a limit, its figures as JSON."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence

THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")

PATIENCE = 20.0
"""By the clock a run may take so many times its limit: on a busy machine a second of the processor takes many."""

GRACE = 10
"""Seconds from the signal that ends a run at its limit to the one that it cannot ignore."""

ONE = "--one"


def in_child(module: str, what: Sequence[str], limit: float) -> dict[str, object]:
    """Figures that ``python -m MODULE --one LIMIT WHAT...`` prints; only ``status`` where it is stopped or fails.

    limit : seconds of the processor
    """
    command = [sys.executable, "-m", module, ONE, f"{limit:.0f}", *what]
    environment = os.environ | dict.fromkeys(THREADS, "1")
    stopped: dict[str, object] = {"status": f"stopped after {limit:.0f} s"}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=PATIENCE * limit, env=environment
        )
    except subprocess.TimeoutExpired:
        return stopped
    if done.returncode == -signal.SIGXCPU:
        return stopped
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        return {"status": f"failed: {last}"}
    figures: dict[str, object] = json.loads(done.stdout.splitlines()[-1])
    return figures


def answer_as_child(arguments: Sequence[str], measure: Callable[..., dict[str, object]]) -> bool:
    """Where the arguments ask for one measurement: make it within its limit and print it; whether they do."""
    if arguments[:1] != [ONE]:
        return False
    limit, *what = arguments[1:]
    resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + GRACE))
    sys.stdout.write(json.dumps(measure(*what)) + "\n")
    return True
