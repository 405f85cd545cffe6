"""What loads act on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mbla.arrays import BoolArray
from mbla.deck.sections.any_load import AnyLoad
from mbla.deck.sections.vehicles import Vehicle
from mbla.deck.units import Units
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.fill import FillBody
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection
from mbla.model.solids.blocks import NO_MASSES, Blocks, PointMasses


@dataclass(frozen=True)
class LoadSite:
    """What loads act on: blocks to choose from, with a place for complaints; those that do not move; the deck's units.

    fixed   : (n_blocks,) blocks that do not move
    resolve_file : path of a file named by the value at a key path of the deck
    grounds : planes of rigid ground
    named   : loads of the deck by name
    tolerance, overlap : greatest gap and greatest overlap of contacts, relative to block size
    fill    : fills by name, through which loads spread
    vehicles : of the deck by name
    masses  : that blocks carry, each by itself
    """

    selection: BlockSelection
    fixed: BoolArray
    units: Units
    resolve_file: Callable[[KeyPath, str], Path]
    grounds: tuple[Ground, ...] = ()
    named: Mapping[str, Sequence[AnyLoad]] = field(default_factory=dict)
    tolerance: float = 1e-3
    overlap: float = 1e-3
    fill: Mapping[str, FillBody] = field(default_factory=dict)
    vehicles: Mapping[str, Vehicle] = field(default_factory=dict)
    masses: PointMasses = NO_MASSES

    @property
    def blocks(self) -> Blocks:
        """All blocks of the model."""
        return self.selection.blocks

    def refuse(self, finding: Finding) -> None:
        """Add a fault, once."""
        self.selection.refuse(finding)

    def warn(self, identifier: str, message: str) -> None:
        """Add a warning, once."""
        self.selection.remark(Notice("warning", identifier, message))
