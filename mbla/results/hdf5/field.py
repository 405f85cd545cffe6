"""One dataset of a result file as a record: path, type, dimensions, unit, meaning."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mbla.deck.units import Units

FieldKind = Literal["float", "int", "bool", "byte", "text"]
UnitKind = Literal[
    "1",
    "time",
    "length",
    "area",
    "volume",
    "density",
    "mass",
    "degree",
    "stress",
    "force",
    "moment",
    "load",
    "per_length",
    "velocity",
    "rotation",
    "velocities",
    "motion",
    "displacement",
]


NOT_VERIFIED = "not verified: {}"
"""attribute of datasets that ``mbla verify`` takes as the run told them"""

VERSIONS, TIMES, FILES = "versions and date", "times", "names of files"
WORDS = "reasons and remarks in words"
COURSE = "how it was solved: scheme, programs, iterations, steps of the path, sizes, reductions"
SEARCHES = "tries that did not agree, ranges of normal forces"
CLAIMED = "that no better answer was found than the status says, without associative flow that it does not fall before"
STANDING = "that it stands only by self-stress, or that it is doubtful whether it stands"
FALLS = "which block falls first"
PASSED = "mechanism of a peak"


@dataclass(frozen=True)
class Field:
    """One dataset.

    dims     : names of its dimensions; none for a single value
    index_of : for indices: the dimension they count (``body`` for blocks and then grounds)
    start_of : for offsets of ragged arrays: the dimension they divide
    open     : non-finite values are allowed: nan for "nothing to say", inf for "unlimited"
    part     : fields of one part are all there or all missing; empty: always there
    told     : what kind of statement it is, of those that the run alone can tell and ``mbla verify`` does not verify
    proved   : texts that are verified all the same, as other datasets prove them
    """

    path: str
    kind: FieldKind
    dims: tuple[str, ...]
    unit: UnitKind
    long_name: str
    index_of: str = ""
    start_of: str = ""
    open: bool = False
    part: str = ""
    told: str = ""
    proved: tuple[str, ...] = ()

    def told_of(self, value: object) -> str:
        """``told`` of a value, empty where that is verified."""
        return "" if isinstance(value, str) and value in self.proved else self.told


def unit_text(kind: UnitKind, units: Units) -> str:
    """The ``units`` attribute, in the deck's units."""
    length, force = units.length, units.force
    return {
        "1": "1",
        "time": "s",
        "length": length,
        "area": f"{length}2",
        "volume": f"{length}3",
        "density": f"{units.mass}/{length}3",
        "mass": units.mass,
        "degree": "degree",
        "stress": f"{force}/{length}2",
        "force": force,
        "moment": f"{force} {length}",
        "per_length": f"1/{length}",
        "load": f"{force}; {force} {length}",
        "velocity": f"1/{force}",
        "rotation": f"1/({force} {length})",
        "velocities": f"1/{force}; 1/({force} {length})",
        "motion": f"1; 1/{length}",
        "displacement": f"{length}; 1",
    }[kind]


def notice_fields(group: str, what: str) -> tuple[Field, ...]:
    """Columns of a list of notices."""
    return (
        Field(f"{group}/severity", "text", ("notice",), "1", f"{what}: notice or warning"),
        Field(f"{group}/identifier", "text", ("notice",), "1", f"{what}: stable identifier"),
        Field(f"{group}/message", "text", ("notice",), "1", f"{what}: in words"),
    )
