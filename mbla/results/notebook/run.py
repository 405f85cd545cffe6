"""A run for Python users: its load cases by name, their figures, and what a notebook shows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mbla.contacts.contacts import Contacts
from mbla.errors import Notice, UsageError
from mbla.model.model import Model
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.notebook.case import Case
from mbla.results.notebook.display import View
from mbla.results.outcome import notices_of
from mbla.results.pictures.image import EncodedPicture
from mbla.results.results import Results
from mbla.results.series import no_such_case, series_of

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class Run:
    """What a run found.

    records : everything, as the result file holds it
    """

    records: Results = field(repr=False)

    @property
    def cases(self) -> tuple[Case, ...]:
        """Load cases in the order of the deck."""
        return tuple(Case(self.records, record) for record in self.records.cases)

    def case(self, name: str) -> Case:
        """The load case of that name; raises UsageError if there is none."""
        for case in self.cases:
            if case.name == name:
                return case
        raise no_such_case(self.records, name)

    def __getitem__(self, name: str) -> Case:
        return self.case(name)

    def __iter__(self) -> Iterator[Case]:
        return iter(self.cases)

    def __len__(self) -> int:
        return len(self.records.cases)

    @property
    def load_factor(self) -> float:
        """Of the only load case, or the least of the positions of one travelling load; nan where there is none.

        Raises
        ------
        UsageError
            There are several load cases, or a travelling load without a worst position: ask ``load_factors``.
        """
        return self._only().load_factor

    @property
    def load_factors(self) -> dict[str, float]:
        """Of every load case by its name; nan where there is none."""
        return {case.name: case.load_factor for case in self.cases}

    @property
    def verified(self) -> bool:
        """Whether the run is complete and every load case has a load factor that is verified in full."""
        return self.records.complete and bool(self.cases) and all(case.verified for case in self.cases)

    @property
    def model(self) -> Model:
        """Blocks, supports, joint laws and loads."""
        return self.records.model

    @property
    def contacts(self) -> Contacts:
        """Interfaces and contact points."""
        return self.records.contacts

    @property
    def units(self) -> dict[str, str]:
        """Of every figure and array: length, force, mass."""
        units = self.records.model.units
        return {"length": units.length, "force": units.force, "mass": units.mass}

    @property
    def notices(self) -> tuple[Notice, ...]:
        """Remarks and warnings of every stage."""
        return notices_of(self.records)

    @property
    def warnings(self) -> tuple[Notice, ...]:
        """What a reader of the figures must know."""
        return tuple(notice for notice in self.notices if notice.severity == "warning")

    @property
    def exit_code(self) -> int:
        """What ``mbla run`` would return: 0 where every case is solved and verified."""
        return self.records.exit_code

    @property
    def summary(self) -> str:
        """What ``mbla run`` prints."""
        return "\n".join(summary_lines(self.records))

    @property
    def listing(self) -> str:
        """The complete listing, as ``mbla show`` prints it."""
        return listing(self.records)

    def to_frames(self, tables: Sequence[str] | None = None) -> dict[str, pandas.DataFrame]:
        """Tables as DataFrames by name: cases, blocks, interfaces, points and so on, as ``mbla export`` writes them.

        tables : only these; None for all

        Raises UsageError where there is no such table, or the extra for tables is not installed.
        """
        from mbla.results.tables.tables import tables_of

        return {name: table.to_pandas() for name, table in tables_of(self.records, tables).items()}

    @property
    def representative_case(self) -> Case | None:
        """The load case whose picture stands for the run: that with the least load factor, or else the first.

        Load factors of settling supports and of tilting tables are of another kind and do not count.
        """
        plain = [case for case in self.cases if case.record.load_case.question.group == "load_factor"]
        known = [case for case in plain if not math.isnan(case.load_factor)]
        return min(known, key=lambda case: case.load_factor) if known else next(iter(self.cases), None)

    def picture(self, *, kind: str = "mechanism", format: str | None = None) -> EncodedPicture:
        """The picture of the only load case; raises as ``load_factor`` and ``Case.picture`` do."""
        return self._only().picture(kind=kind, format=format)

    def show(self) -> View:
        """The view of the only load case, to be turned; raises as ``load_factor`` and ``Case.show`` do."""
        return self._only().show()

    def _only(self) -> Case:
        """The only load case, or the worst position of the only series; of a series without a worst its first."""
        series = series_of(self.records.cases)
        if len(series) == 1 and len(series[0].cases) == len(self):
            worst = series[0].worst
            if worst is None:
                raise UsageError(
                    "no-least-load-factor",
                    f"{series[0].name}: no least load factor is known; ask load_factors for each position",
                )
            return Case(self.records, worst)
        if len(self) != 1:
            names = ", ".join(case.name for case in self.cases) or "none"
            raise UsageError(
                "load-case-not-chosen", f"the result has {len(self)} load cases; name one with case(): {names}"
            )
        return self.cases[0]

    def __repr__(self) -> str:
        return f"<mbla run of {self.summary}>"

    def _repr_html_(self) -> str:
        from mbla.results.notebook.display import run_html

        return run_html(self)
