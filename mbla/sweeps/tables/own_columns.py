"""Columns that every table of a sweep has, whatever it varies and asks for."""

from __future__ import annotations

from mbla.sweeps.tables.sweep_table import SweepColumn

POINT = SweepColumn("point", "", "number of the point in the design, from 1", "int", "number")
STATE = SweepColumn("state", "", "done: every load case has a verified answer; failed: one has none", "text", "state")
AFTER = (
    SweepColumn("exit_code", "", "exit status that `mbla run` of the same deck ends with", "int", "exit_code"),
    SweepColumn("reason", "", "why it failed or has no load factor", "text", "reason"),
    SweepColumn("tries", "", "how often it was begun", "int", "tries"),
    SweepColumn("seconds", "s", "time by the clock, of the last try", "float", "seconds"),
)
"""columns after the results"""
