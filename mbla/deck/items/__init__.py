"""The items of `blocks`: one file per kind, with its rules. A new one is a file, two lines here and a generator."""

from __future__ import annotations

from mbla.deck.items.arch import ArchItem
from mbla.deck.items.bridge import BridgeItem
from mbla.deck.items.column import ColumnItem
from mbla.deck.items.cuboids import BoxItem, PolyhedronItem, StackItem, TrilithonItem
from mbla.deck.items.dome import DomeItem
from mbla.deck.items.files import MeshItem, TableItem
from mbla.deck.items.spiral_stair import SpiralStairItem
from mbla.deck.items.vaults import BarrelVaultItem, CrossVaultItem, PavilionVaultItem
from mbla.deck.items.walls import WallItem, WallsItem
from mbla.deck.section import Section, exactly_one_of


@exactly_one_of()
class BlockItem(Section):
    """An item of `blocks`: exactly one key, its kind."""

    box: BoxItem | None = None
    polyhedron: PolyhedronItem | None = None
    wall: WallItem | None = None
    walls: WallsItem | None = None
    arch: ArchItem | None = None
    mesh: MeshItem | None = None
    table: TableItem | None = None
    column: ColumnItem | None = None
    stack: StackItem | None = None
    trilithon: TrilithonItem | None = None
    bridge: BridgeItem | None = None
    dome: DomeItem | None = None
    barrel_vault: BarrelVaultItem | None = None
    cross_vault: CrossVaultItem | None = None
    pavilion_vault: PavilionVaultItem | None = None
    spiral_stair: SpiralStairItem | None = None
