"""The table of a sweep: one row for each point in the order of the design, whatever order they were solved in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from mbla.arrays import IntArray
from mbla.results.tables.column import Values
from mbla.sweeps.design.design import Dimension


@dataclass(frozen=True)
class SweepColumn:
    """One column.

    kind : ``float``, ``int``, ``bool`` or ``text``
    role : ``number`` of the point; ``parameter``, ``azimuth``, ``elevation`` of the design; ``state``, ``exit_code``,
           ``reason``, ``tries``, ``seconds``; ``result``
    case : load case of a result, empty for others
    path : key path of a result in the JSON object of its case or run, empty for others
    """

    name: str
    unit: str
    words: str
    kind: str
    role: str
    dimension: str = ""
    random: bool = False
    case: str = ""
    path: str = ""

    @property
    def header(self) -> str:
        """``thickness [m]``; the name alone where there is no unit."""
        return header_of(self.name, self.unit)


def header_of(name: str, unit: str) -> str:
    """A name with its unit, as headers of tables have it."""
    return f"{name} [{unit}]" if unit else name


@dataclass(frozen=True)
class SweepTable:
    """Points of a sweep with their results.

    values     : an array (n_points,) for each column: float with nan, whole numbers and truth values masked where there
                 is none, text as objects with None
    dimensions : axes of the design, slowest first
    position   : (n_points, n_dimensions) of each point along them, from 0
    levels     : of each column of the design, its values along its dimension, also those at which constraints leave no
                 point; not known of a table that is read back from its files
    samples, sampling : as of ``Design``
    """

    title: str
    columns: tuple[SweepColumn, ...]
    values: tuple[Values, ...]
    dimensions: tuple[Dimension, ...]
    position: IntArray
    levels: Mapping[str, Values] = field(default_factory=dict)
    samples: str = ""
    sampling: str = ""

    def __len__(self) -> int:
        return len(self.position)

    def __getitem__(self, name: str) -> Values:
        """The values of a column by its name; KeyError if there is none."""
        for column, values in zip(self.columns, self.values, strict=True):
            if column.name == name:
                return values
        raise KeyError(name)

    def of_role(self, *roles: str) -> tuple[SweepColumn, ...]:
        """Columns with one of these roles."""
        return tuple(column for column in self.columns if column.role in roles)
