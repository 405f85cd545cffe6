"""All quantities: the modules that declare them are imported here, and what the renderers take of them."""

from __future__ import annotations

from mbla.results.quantities import (  # noqa: F401
    answers,
    base_motion,
    blocks,
    cases,
    further,
    history_tables,
    interfaces,
    loads,
    model,
    modes,
    moving,
    points,
    run,
    series,
    solving,
    steps,
    supports,
    ties,
    time_history,
    time_spectra,
)
from mbla.results.quantities.group import DECLARED
from mbla.results.quantities.quantity import Quantity

OF_RUN = tuple(each for each in DECLARED if each.group.split("/")[0] in ("deck", "notices", "provenance"))
"""those of the result file that belong to results as a whole"""
OF_MODEL = tuple(each for each in DECLARED if each.group.split("/")[0] in ("model", "contacts"))
"""those of the result file that belong to a scene without a load case"""
OF_CASES = tuple(each for each in DECLARED if each.group.startswith("cases/"))
"""those of the result file that belong to a scene of a load case"""
STORED: tuple[Quantity, ...] = (*OF_RUN, *OF_MODEL, *OF_CASES)
"""in the order of writing"""
STORED_BY_PATH: dict[str, Quantity] = {each.path: each for each in STORED}


def columns_of(table: str) -> tuple[Quantity, ...]:
    """Of a table, in the order of declaration."""
    return tuple(each for each in DECLARED if each.table == table)


def held(record: type, group: str) -> dict[str, str]:
    """Names in a group of the result file by the field of the dataclass that they are."""
    return {each.attribute: each.name for each in STORED if each.record is record and each.group == group}


CASE_COLUMNS, BLOCK_COLUMNS = columns_of("cases"), columns_of("blocks")
COLUMN = {each.name: each for each in CASE_COLUMNS}
"""columns of load cases by name"""
INTERFACE_COLUMNS, POINT_COLUMNS = columns_of("interfaces"), columns_of("points")
