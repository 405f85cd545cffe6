"""A run as one JSON object: what ``--json`` prints and ``STEM.json`` holds.

Values that do not exist are None, numbers are finite.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mbla import __version__
from mbla.contacts.glue import solid_sizes
from mbla.deck.units import Units
from mbla.errors import Notice
from mbla.results.findings import remarks_of_run
from mbla.results.force_range import ForceRange, force_ranges_of
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.listing.history_words import NOT_CHECKED, NOT_FOLLOWED, history_words, pushovers_words
from mbla.results.outcome import dimension_of, notices_of, standing_of, unproved_words
from mbla.results.quantities.run import NOTICES
from mbla.results.record.case_record import CASE
from mbla.results.record.json_values import as_json
from mbla.results.record.objects import Item, Object
from mbla.results.record.scene import Scene, scene_of
from mbla.results.record.series_record import OBJECTIVE, SERIES, SeriesOfModel
from mbla.results.results import Results
from mbla.results.series import series_of

RUN, MODEL, NOTICE, UNITS = Object[Results](), Object[Results](), Object[Notice](), Object[Units]()


@RUN.key()
def mbla(results: Results) -> str:
    """Version of the program."""
    return results.provenance.get("mbla", __version__)


@RUN.key()
def deck(results: Results) -> str:
    """File name of the deck."""
    return results.deck.name


@RUN.key()
def deck_sha256(results: Results) -> str:
    """Hash of the effective deck."""
    return results.deck.sha256


RUN.fields(
    Results,
    created=Item("date of the run, UTC, ISO 8601"),
    exit_code=Item("exit status of the run"),
)


@RUN.key(inside=MODEL)
def model(results: Results) -> Results:
    """Counts and totals of the model."""
    return results


@RUN.key("a load case", inside=CASE)
def cases(results: Results) -> list[Scene]:
    """Load cases that were run."""
    return [scene_of(results, case) for case in results.cases]


@RUN.key("a travelling load", inside=SERIES)
def series(results: Results) -> list[SeriesOfModel]:
    """Travelling loads: the load cases that are positions of one."""
    return [SeriesOfModel(results.model, series) for series in series_of(results.cases)]


@RUN.key("a force", inside=OBJECTIVE)
def objectives(results: Results) -> list[ForceRange]:
    """Forces that are sought: their least and greatest value."""
    return list(force_ranges_of(results.cases))


@RUN.key("value of a setting")
def settings(results: Results) -> dict[str, str]:
    """Analysis settings in effect."""
    return results.settings


@RUN.key("a remark", inside=NOTICE)
def notices(results: Results) -> list[Notice]:
    """Remarks and warnings."""
    return list(notices_of(results))


@RUN.key("time of a stage: read, contacts, solve, write; a part of one after a slash", unit="time")
def time(results: Results) -> dict[str, float]:
    """By stage."""
    return results.time


@RUN.key("a file")
def files(results: Results) -> list[str]:
    """Names of the files of the run."""
    return list(results.files)


RUN.fields(
    Results,
    complete=Item("whether the run completed; false: cases are those completed before it stopped"),
)


@RUN.key("name of a load case")
def not_done(results: Results) -> list[str]:
    """Load cases that a stopped run did not reach."""
    return list(results.not_done)


NOTICE.quantities(*NOTICES.quantities)


@NOTICE.key(missing=True)
def case(notice: Notice) -> str:
    """Load case that it is about; missing where it is about the entire run."""
    return notice.case


# --- The model --------------------------------------------------------------------------------------------------------


@MODEL.key()
def standing(results: Results) -> str | None:
    """Worst verdict of the cases on standing: yes, only by self-stress, no, doubtful."""
    return standing_of(results.cases)


@MODEL.key()
def dimension(results: Results) -> int:
    """2 where every case was solved as planar, else 3."""
    return dimension_of(results.cases)


@MODEL.key()
def title(results: Results) -> str:
    """Title of the deck."""
    return results.model.title


@MODEL.key()
def blocks(results: Results) -> int:
    """Blocks."""
    return len(results.model.blocks)


@MODEL.key()
def free_blocks(results: Results) -> int:
    """Blocks that can move."""
    return len(results.model.free)


@MODEL.key("a corner", "a coordinate", unit="length")
def extents(results: Results) -> list[list[float]]:
    """Lower and upper corner of the box around the blocks."""
    vertices = results.model.blocks.vertices
    return [vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()]


@MODEL.key(unit="volume")
def total_volume(results: Results) -> float:
    """Volume of all blocks."""
    return float(results.model.blocks.volumes.sum())


@MODEL.key(unit="force")
def total_weight(results: Results) -> float:
    """Their weight under standard gravity."""
    return results.model.total_weight


@MODEL.key(unit="mass")
def added_mass(results: Results) -> float:
    """Mass that blocks carry in addition to their own."""
    return float(results.model.blocks.added_masses.sum())


@MODEL.key(unit="mass")
def fill_mass(results: Results) -> float:
    """The part of it that is fill."""
    fill = results.model.fill
    return 0.0 if fill is None else float(fill.masses.sum())


@MODEL.key(inside=UNITS)
def units(results: Results) -> Units:
    """Units of the deck; all numbers are in them."""
    return results.model.units


UNITS.fields(Units, length=Item("unit of length"), force=Item("unit of force"), mass=Item("unit of mass"))


@MODEL.key()
def open_interfaces(results: Results) -> int:
    """Interfaces left out as their joint law is open."""
    return results.contacts.report.open_interfaces


@MODEL.key()
def glued_interfaces(results: Results) -> int:
    """Internal interfaces of glued bodies."""
    return len(results.contacts.report.glued)


@MODEL.key()
def glued_blocks(results: Results) -> int:
    """Blocks glued to others."""
    return int(solid_sizes(results.contacts.solid_of_block).sum())


@MODEL.key()
def rigid_bodies(results: Results) -> int:
    """Bodies that they form."""
    return len(solid_sizes(results.contacts.solid_of_block))


@MODEL.key()
def held_blocks(results: Results) -> int:
    """Blocks that do not move because they are glued to a support."""
    return len(results.contacts.report.held)


@MODEL.key()
def interfaces(results: Results) -> int:
    """Interfaces."""
    return len(results.contacts)


@MODEL.key()
def contact_points(results: Results) -> int:
    """Contact points."""
    return len(results.contacts.points)


@MODEL.key(unit="area")
def contact_area(results: Results) -> float:
    """Area of all interfaces."""
    return float(results.contacts.areas.sum())


def results_json(results: Results) -> dict[str, Any]:
    """The record of a run; values that do not exist are None, those of mechanisms are found when they are asked for."""
    return dict(RUN.json(results))


def verification_json(results: Results, disagreements: Sequence[str]) -> dict[str, Any]:
    """The record of a verification: figures recomputed, where the file says otherwise, and what was not verified."""
    return results_json(results) | {
        "agrees": not disagreements and not results.unconfirmed,
        "disagreements": list(disagreements),
        "not_confirmed": list(results.unconfirmed),
        "paths_again": as_json(results.paths_again),
        "pushovers_again": as_json(results.pushovers_again),
        "not_verified": [
            *unverified_kinds(results),
            *((NOT_CHECKED,) if NOT_CHECKED in history_words(results) else ()),
            *((NOT_FOLLOWED,) if NOT_FOLLOWED in pushovers_words(results) else ()),
            *unproved_words(results.cases),
            *remarks_of_run(results.cases),
        ],
    }
