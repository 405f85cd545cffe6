"""One load case for Python users: its figures and arrays where they are results, its words, its picture."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.results.assessment import Assessment
from mbla.results.collapse.collapse import Collapse, collapse_of, failure_of
from mbla.results.collapse.thrust import Thrust, thrust_of
from mbla.results.history_figures import HistoryFigures
from mbla.results.listing.sections.assessment_words import code_verdict
from mbla.results.listing.sections.mechanism_words import mechanism_summary
from mbla.results.listing.verdict_words import reasons, verdict
from mbla.results.notebook.display import View, case_picture
from mbla.results.outcome import answer_of, associative_of, history_of, least_of, result_of, torsion_of
from mbla.results.pictures.image import EncodedPicture
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Mechanics, Status

NAN = float("nan")


@dataclass(frozen=True)
class Case:
    """One load case of a run. A figure that is no result is nan and an array None; ``reason`` says why.

    results : the entire run
    record  : everything that was found, also what is no result (``record.solution.mechanics`` is the best iterate)

    Arrays are in the units of the deck (``units``), blocks and contact points in the order of ``results.model.blocks``
    and ``results.contacts``.
    """

    results: Results = field(repr=False)
    record: CaseResult = field(repr=False)

    @property
    def name(self) -> str:
        """Of the load case."""
        return self.record.load_case.name

    @property
    def status(self) -> Status:
        """``solved``, ``approximate``, ``not_verified``, ``no_equilibrium``, ``unbounded`` and so on; it is a text."""
        return self.record.status

    @property
    def verified(self) -> bool:
        """Whether the load factor, or the history in time, is a result that the verification confirms in full."""
        found = result_of(self.record) or history_of(self.record)
        return self.status is Status.SOLVED and found is not None

    @property
    def load_factor(self) -> float:
        """By the deck's flow rule; nan where there is none (see ``reason``)."""
        return _factor(result_of(self.record))

    @property
    def least_load_factor(self) -> float:
        """Of the states of rigid joints that a search found; nan where none ran, or it came to none."""
        return least_of(self.record)

    @property
    def torsion_load_factor(self) -> float:
        """In space, with torsion of uniform pressure; nan where no path with it was followed, or it is not verified."""
        return torsion_of(self.record)

    @property
    def associative_load_factor(self) -> float:
        """By associative flow, an upper limit to all others; nan where it is not known."""
        return _factor(associative_of(self.record))

    @property
    def static_bound(self) -> float:
        """A load factor that associative flow certainly bears; nan where nothing is proved."""
        return self.record.checks.static_bound

    @property
    def kinematic_bound(self) -> float:
        """A load factor that no flow rule exceeds; nan where nothing is proved."""
        return self.record.checks.kinematic_bound

    @property
    def angle(self) -> float:
        """Angle of collapse of a tilting table in degrees; nan for other load cases."""
        return answer_of(self.record, "angle")

    @property
    def reaction(self) -> float:
        """Least reaction of a settling support, force, or force times length; nan for other load cases."""
        return answer_of(self.record, "reaction")

    @property
    def time_history(self) -> HistoryFigures | None:
        """What a structure does in time: peak, residual displacement, what falls; None where that is no result.

        Its histories, states and energies are in ``record.solution.further.time_history``.
        """
        return history_of(self.record)

    @property
    def mechanics(self) -> Mechanics | None:
        """Forces and velocities at the load factor; None where they are no result."""
        return result_of(self.record)

    @property
    def mechanism(self) -> FloatArray | None:
        """Velocity and angular velocity of each block about its centroid, (n_blocks, 6); live load power is 1."""
        found = result_of(self.record)
        return None if found is None else found.mechanism

    @property
    def contact_forces(self) -> FloatArray | None:
        """Normal force and two tangential ones at each contact point, compression positive, (n_points, 3)."""
        found = result_of(self.record)
        return None if found is None else found.contact_forces

    @property
    def contact_modes(self) -> IntArray | None:
        """ContactMode of each contact point: 0 stick, 1 slide, 2 open, 3 crush, (n_points,)."""
        found = result_of(self.record)
        return None if found is None else found.modes

    @property
    def certificate(self) -> FloatArray | None:
        """Without equilibrium: verified motion in which the dead load falls, (n_blocks, 6); None otherwise."""
        return self.record.solution.certificate if self.status is Status.NO_EQUILIBRIUM else None

    @property
    def collapse(self) -> Collapse | None:
        """What interfaces do, blocks that move together and where the power goes."""
        found = result_of(self.record)
        if found is None:
            return None
        return collapse_of(self.results.assembly, self.record.load_case, found)

    @property
    def curve(self) -> FloatArray | None:
        """Steps of the pushover, the structure as built first: displacement of the control point (of the support, where
        one gives way) and load factor (its reaction; of a tilting table the angle in degrees), (n_steps + 1, 2); None
        where none was asked for or made.

        ``record.solution.further.pushover.curve`` has all that is known of each step, ``curve_end`` why it ends.
        """
        rows = self.record.solution.further.pushover.curve
        return np.array([[row.displacement, row.answer] for row in rows]) if rows else None

    @property
    def assessment(self) -> Assessment | None:
        """What a code says: ``assessment.ratios["SLV"].value`` is capacity over demand; None where none was asked for.

        ``figures`` has every figure on the way with its article, ``remarks`` what stands against them.
        """
        return self.record.assessment

    @property
    def thrust(self) -> Thrust | None:
        """Resultant of each interface, where it acts, its eccentricity and use of friction."""
        found = result_of(self.record)
        return None if found is None else thrust_of(self.model, self.results.contacts, found.contact_forces)

    @property
    def model(self) -> Model:
        """The model as it may move in this load case."""
        return self.results.model.of_case(self.record.load_case)

    @property
    def verdict(self) -> str:
        """The outcome in one line, as ``collapses at 0.145 g, verified``."""
        return verdict(self.model, self.record)

    @property
    def reason(self) -> str:
        """Why it is not plainly solved; empty where it is."""
        if self.verified:
            return ""
        return "; ".join([self.verdict, *reasons(self.record)])

    @property
    def summary(self) -> str:
        """Verdict, and how it collapses: hinges, sliding, parts."""
        found, collapse = result_of(self.record), self.collapse
        how = ""
        if found is not None and collapse is not None:
            failure = failure_of(self.model, self.results.contacts, collapse, found)
            how = f": {mechanism_summary(self.model, collapse, failure)}"
        code = code_verdict(self.record)
        return f"{self.name}: {self.verdict}{how}{f'. {code}' if code else ''}"

    def picture(
        self, path: str | Path | None = None, *, kind: str = "mechanism", format: str | None = None
    ) -> EncodedPicture:
        """A picture of the mechanism, of the structure at rest where there is none, or of another kind.

        Parameters
        ----------
        path
            Also write it there; its suffix is the format.
        kind
            ``model``, ``mechanism``, ``forces`` or ``history``.
        format
            ``png``, ``svg`` or ``pdf``; default: png.

        Raises
        ------
        UsageError
            The extra for pictures is not installed, the machine cannot draw, or another kind or format.
        FileError
            It cannot be written.
        """
        return case_picture(self.results, self.record, kind, None if path is None else Path(path), format)

    def show(self) -> View:
        """A view to be turned with the mouse: shown by a notebook, or written with ``save``.

        Raises UsageError where the extra for reports is not installed.
        """
        return View.of_case(self.results, self.record)

    def __repr__(self) -> str:
        return f"<mbla load case {self.summary}>"

    def _repr_html_(self) -> str:
        from mbla.results.notebook.display import case_html

        return case_html(self)


def _factor(mechanics: Mechanics | None) -> float:
    return math.nan if mechanics is None else float(mechanics.load_factor)
