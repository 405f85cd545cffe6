"""A run as one JSON object: what ``--json`` prints and ``STEM.json`` holds.

Values that do not exist are None, numbers are finite.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mbla import __version__
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.contacts.glue import solid_sizes
from mbla.deck.units import Units
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks
from mbla.results.findings import not_checked, not_followed, remarks_of_run
from mbla.results.force_range import ForceRange, force_ranges_of
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.outcome import dimension_of, notices_of, standing_of, unproved_words
from mbla.results.quantities.group import Field, count, total
from mbla.results.quantities.registry import STORED_BY_PATH
from mbla.results.quantities.run import NOTICES
from mbla.results.record.case_record import CASE
from mbla.results.record.json_values import as_json
from mbla.results.record.objects import Object, json_of
from mbla.results.record.scene import Scene, scene_of
from mbla.results.record.series_record import OBJECTIVE, SERIES, SeriesOfModel
from mbla.results.results import DeckRecord, Results
from mbla.results.series import series_of

RUN, MODEL, NOTICE = Object[Results](), Object[Results](), Object[Notice](*NOTICES.quantities)
_RECORD, _MODEL = RUN.of(lambda results: results.deck), MODEL.of(lambda results: results.model)
_BLOCKS = MODEL.of(lambda results: results.model.blocks)
_CONTACTS, _REPORT = MODEL.of(lambda results: results.contacts), MODEL.of(lambda results: results.contacts.report)
UNITS = Object[Units]()


@RUN.key()
def mbla(results: Results) -> str:
    """Version of the program."""
    return results.provenance.get("mbla", __version__)


_RECORD.fields(
    DeckRecord,
    deck=Field("file name of the deck", attribute="name"),
    deck_sha256=Field("hash of the effective deck", attribute="sha256"),
)
RUN.fields(Results, created=Field("date of the run, UTC, ISO 8601"))
RUN.quantities.append(STORED_BY_PATH["provenance/exit_code"])
RUN.holds("model", MODEL, "counts and totals of the model")


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


RUN.fields(Results, settings=Field("analysis settings in effect", items=("value of a setting",)))


@RUN.key("a remark", inside=NOTICE)
def notices(results: Results) -> list[Notice]:
    """Remarks and warnings."""
    return list(notices_of(results))


RUN.fields(
    Results,
    time=Field(
        "by stage",
        items=("time of a stage: read, contacts, soil (moving its cells), solve, write; a part of one after a slash",),
        unit="time",
    ),
    files=Field("names of the files of the run", items=("a file",)),
    complete=Field("whether the run completed; false: cases are those completed before it stopped"),
    not_done=Field("load cases that a stopped run did not reach", items=("name of a load case",)),
)
NOTICE.fields(Notice, case=Field("load case that it is about; missing where it is about the entire run", missing=True))


# --- The model --------------------------------------------------------------------------------------------------------


@MODEL.key()
def standing(results: Results) -> str | None:
    """Worst verdict of the cases on standing: yes, only by self-stress, no, doubtful."""
    return standing_of(results.cases)


@MODEL.key()
def dimension(results: Results) -> int:
    """2 where every case is solved as planar, else 3."""
    return dimension_of(results.cases)


MODEL.quantities.append(STORED_BY_PATH["model/title"])


@_MODEL.key()
def blocks(model: Model) -> int:
    """Blocks, cells of soil not among them."""
    return int((model.soil_of_block < 0).sum())


@_MODEL.key()
def free_blocks(model: Model) -> int:
    """Those of them that can move."""
    return int((model.soil_of_block[model.free] < 0).sum())


@_MODEL.key("of a soil")
def soil_cells(model: Model) -> dict[str, int]:
    """Rigid cells of each soil."""
    return {soil.name: len(soil.triangles) for soil in model.soils}


@_BLOCKS.key("a corner", "a coordinate", unit="length")
def extents(blocks: Blocks) -> list[list[float]]:
    """Lower and upper corner of the box around the blocks."""
    return [blocks.vertices.min(axis=0).tolist(), blocks.vertices.max(axis=0).tolist()]


_BLOCKS.fields(Blocks, total_volume=Field("volume of all blocks", unit="volume", attribute="volumes", by=total))
_MODEL.fields(Model, total_weight=Field("their weight under standard gravity", unit="force"))
_BLOCKS.fields(
    Blocks,
    added_mass=Field(
        "mass that blocks carry in addition to their own", unit="mass", attribute="added_masses", by=total
    ),
)


@MODEL.key(unit="mass")
def fill_mass(results: Results) -> float:
    """The part of it that is fill."""
    fill = results.model.fill
    return 0.0 if fill is None else total(fill.masses)


_MODEL.fields(Model, units=Field("units of the deck; all numbers are in them", inside=UNITS))
UNITS.fields(Units, length=Field("unit of length"), force=Field("unit of force"), mass=Field("unit of mass"))
_REPORT.fields(
    ContactReport,
    open_interfaces=Field("interfaces left out as their joint law is open"),
    glued_interfaces=Field("internal interfaces of glued bodies", attribute="glued", by=count),
)


@_CONTACTS.key()
def glued_blocks(contacts: Contacts) -> int:
    """Blocks glued to others."""
    return int(solid_sizes(contacts.solid_of_block).sum())


@_CONTACTS.key()
def rigid_bodies(contacts: Contacts) -> int:
    """Bodies that they form."""
    return len(solid_sizes(contacts.solid_of_block))


_REPORT.fields(
    ContactReport,
    held_blocks=Field("blocks that do not move because they are glued to a support", attribute="held", by=count),
)
_CONTACTS.fields(
    Contacts,
    interfaces=Field("interfaces", attribute="areas", by=count),
    contact_points=Field("contact points", attribute="points", by=count),
    contact_area=Field("area of all interfaces", unit="area", attribute="areas", by=total),
)


def results_json(results: Results) -> dict[str, Any]:
    """The record of a run; values that do not exist are None, those of mechanisms are found when they are asked for."""
    return dict(json_of(RUN, results))


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
            *not_checked(results),
            *not_followed(results),
            *unproved_words(results.cases),
            *remarks_of_run(results.cases),
        ],
    }
