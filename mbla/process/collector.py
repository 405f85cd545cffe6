"""The cyclic garbage collector of Python, kept from walking through what is there to stay."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from mbla.process.signals import held_signals


@contextmanager
def no_collection() -> Iterator[None]:
    """Pause the collector where objects are made by the hundred thousand and none of them in cycles.

    It would walk through them again and again: a third of the time that a deck of 5,000 polyhedra takes to read, an
    eighth of that of importing what a run needs.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


@contextmanager
def loading() -> Iterator[None]:
    """Import modules: the collector is paused, and passes over them, as over all else that is there, from then on.

    Where none was new nothing is kept from it. Signals wait, as libraries that are being loaded may report an
    interruption as an error of their own.
    """
    before = len(sys.modules)
    with no_collection(), held_signals():
        yield
        if len(sys.modules) > before:
            gc.freeze()  # before the collector may run again, which would walk through them once
