"""The run: the deck with all that it is made of, versions, settings, times, and what was remarked."""

from __future__ import annotations

import numpy as np

from mbla.arrays import ByteArray, IntArray, starts
from mbla.errors import Notice
from mbla.results.outcome import notices_of
from mbla.results.quantities.group import Field, Group
from mbla.results.results import DeckRecord, Results

DECK = Group[DeckRecord](lambda results: results.deck, file="deck")
RUN = Group[Results](lambda results: results, file="provenance")
NOTICES = Group[tuple[Notice, ...]](lambda results: results.notices, file="notices", rows="notice")
_OF_MODEL = Group[tuple[Notice, ...]](lambda scene: scene.model.notices, file="model/notices", rows="notice")
_OF_CONTACTS = Group[tuple[Notice, ...]](
    lambda scene: scene.contacts.report.notices, file="contacts/notices", rows="notice"
)
REMARKS = Group[tuple[Notice, ...]](notices_of, files="table", table="notices", rows="")
"""those of the run and those of its load cases"""

DECK.fields(
    DeckRecord,
    name=Field("file name of the deck"),
    overrides=Field("values changed by the user, on the command line or in Python", "override"),
)


@DECK.quantity(dims="source")
def source_names(deck: DeckRecord) -> list[str]:
    """Files that make the deck, the main one first, with their paths from its folder."""
    return [name for name, _ in deck.sources]


@DECK.quantity(dims="source")
def source_texts(deck: DeckRecord) -> list[str]:
    """Their text."""
    return [text for _, text in deck.sources]


@DECK.quantity(dims="file")
def file_names(deck: DeckRecord) -> list[str]:
    """Meshes and tables that it names, and what belongs to them."""
    return [name for name, _ in deck.files]


@DECK.quantity(dims="file_bound", rule="start of file_byte")
def file_start(deck: DeckRecord) -> IntArray:
    """First byte of each."""
    return starts(np.array([len(content) for _, content in deck.files], dtype=np.int64))


@DECK.quantity(dims="file_byte")
def file_bytes(deck: DeckRecord) -> ByteArray:
    """Their content."""
    return np.frombuffer(b"".join(content for _, content in deck.files), dtype=np.uint8)


def _declare_notices(group: Group[tuple[Notice, ...]], whose: str) -> None:
    group.fields(
        Notice,
        severity=Field(f"{whose}: notice or warning"),
        identifier=Field(f"{whose}: stable identifier, as `mbla explain` takes it"),
        message=Field(f"{whose}: in words"),
    )


_declare_notices(_OF_MODEL, "from building the model")
_declare_notices(_OF_CONTACTS, "from finding the contacts")
_declare_notices(NOTICES, "all remarks of the run")
REMARKS.fields(
    Notice,
    severity=Field("notice or warning"),
    identifier=Field("stable identifier"),
    message=Field("in words"),
    case=Field("load case that it is about; empty: the entire run"),
)


@RUN.quantity(dims="entry", unverified="versions")
def names(results: Results) -> list[str]:
    """Programs, libraries, platform."""
    return list(results.provenance)


@RUN.quantity(dims="entry", unverified="versions")
def values(results: Results) -> list[str]:
    """Their versions."""
    return list(results.provenance.values())


@RUN.quantity(dims="setting")
def setting_names(results: Results) -> list[str]:
    """Analysis settings in effect."""
    return list(results.settings)


@RUN.quantity(dims="setting")
def setting_values(results: Results) -> list[str]:
    """Their values."""
    return list(results.settings.values())


@RUN.quantity(dims="stage", unverified="times")
def stage_names(results: Results) -> list[str]:
    """Stages of the run."""
    return list(results.time)


@RUN.quantity(dims="stage", unit="time", unverified="times")
def stage_seconds(results: Results) -> list[float]:
    """Time of each stage."""
    return list(results.time.values())


RUN.fields(
    Results,
    files=Field("names of the files of this run", "file", unverified="files"),
    exit_code=Field("exit status of the run"),
)


@RUN.quantity(dims="case", part="stopped", unverified="course")
def not_done(results: Results) -> tuple[str, ...] | None:
    """Load cases not done by a stopped run."""
    return None if results.complete else results.not_done
