"""The journal of a sweep: one row for each finished point, on the disk before anybody is told that it is finished."""

from __future__ import annotations

from mbla.studies.sweep.journal.header import JournalHeader
from mbla.studies.sweep.journal.journal import Journal

__all__ = ["Journal", "JournalHeader"]
