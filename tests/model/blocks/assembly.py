"""Items built as a deck would build them, with their contacts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mbla.arrays import FloatArray
from mbla.contacts import Contacts, find_contacts
from mbla.model import Model, build_model
from tests.model.shapes import deck


@dataclass(frozen=True)
class Assembly:
    """A model and its contacts."""

    model: Model
    contacts: Contacts

    def volume_of(self, member: str) -> FloatArray:
        """Volumes of the blocks of a member."""
        blocks = self.model.blocks
        return blocks.volumes[[name == member for name in blocks.labels.members]]


def assemble(folder: Path, *items: str, supports: str = "[{ground: {z: 0}}]", tolerance: float = 1e-3) -> Assembly:
    """Items of a deck: sound blocks that touch without overlaps, gaps or slivers, and all stand on something."""
    read = deck(folder, items, supports, tolerance=tolerance)
    model = build_model(read)
    contacts = find_contacts(model, read.content.contacts)
    report = contacts.report
    assert [notice for notice in model.notices if notice.identifier != "block-size-unusual"] == []
    assert len(report.overlaps) == len(report.unchecked) == 0, report.overlaps
    assert len(report.near_misses) == len(report.slivers) == 0
    assert len(report.isolated) == len(report.unsupported) == 0
    return Assembly(model, contacts)
