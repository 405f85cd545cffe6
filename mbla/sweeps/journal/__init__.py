"""The journal of a sweep: one row for each finished point, on the disk before anybody is told that it is finished."""

from __future__ import annotations

from mbla.sweeps.journal.header import JournalHeader
from mbla.sweeps.journal.journal import Journal

__all__ = ["Journal", "JournalHeader"]
