"""Libraries that take long to import, without what of them nothing here needs."""

from __future__ import annotations

from importlib import import_module

import numpy as np


def import_scipy() -> None:
    """Scipy takes over all names of numpy, with what loads a compiler and a test suite: a tenth of a run's imports."""
    unneeded = [name for name in ("f2py", "testing", "polynomial") if name not in vars(np)]
    vars(np).update(dict.fromkeys(unneeded))
    try:
        import_module("scipy.sparse")
    finally:
        for name in unneeded:
            if vars(np).get(name) is None:
                del vars(np)[name]
