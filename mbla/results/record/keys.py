"""What the keys of the JSON record mean, as one table: a section of schemas/results.md.

Types are those of JSON; a question mark: or null, where there is no such value.
"""

from __future__ import annotations

from mbla.results.record import check_record
from mbla.results.record.json_record import RUN
from mbla.results.record.objects import Key as Key

RUN_RECORD: tuple[Key, ...] = tuple(RUN.keys())
"""keys of the record of a run"""
RECORD: tuple[Key, ...] = (
    *RUN_RECORD,
    *check_record.MODEL.keys("model."),
    Key("needs", "object", "`mbla check`: what reaches the solver, by load case"),
    Key("needs.*", "object", "of a load case"),
    Key("needs.*.*", "integer", "counts by name"),
    Key("needs.*.solver", "string", "who solves its programs"),
    *check_record.NEEDS.keys("needs.*."),
)
"""these, and those of ``mbla check`` alone"""
