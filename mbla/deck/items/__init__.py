"""The items of `blocks`: one file per kind. A new one is a file, a line here and a generator."""

from __future__ import annotations

from mbla.deck.items.arch import ArchItem as ArchItem
from mbla.deck.items.arch import ArchPiers as ArchPiers
from mbla.deck.items.barrel_vault import BarrelVaultItem as BarrelVaultItem
from mbla.deck.items.box import BoxItem as BoxItem
from mbla.deck.items.bridge import BridgeAbutments as BridgeAbutments
from mbla.deck.items.bridge import BridgeItem as BridgeItem
from mbla.deck.items.bridge import BridgeParapets as BridgeParapets
from mbla.deck.items.bridge import BridgePiers as BridgePiers
from mbla.deck.items.column import ColumnEnd as ColumnEnd
from mbla.deck.items.column import ColumnItem as ColumnItem
from mbla.deck.items.cross_vault import CrossVaultItem as CrossVaultItem
from mbla.deck.items.dome import DomeDrum as DomeDrum
from mbla.deck.items.dome import DomeItem as DomeItem
from mbla.deck.items.item import Item as Item
from mbla.deck.items.item import Reflection as Reflection
from mbla.deck.items.item import Repetition as Repetition
from mbla.deck.items.item import Rotation as Rotation
from mbla.deck.items.item import TransformStep as TransformStep
from mbla.deck.items.masonry import Masonry as Masonry
from mbla.deck.items.masonry import Opening as Opening
from mbla.deck.items.mesh import MeshItem as MeshItem
from mbla.deck.items.pavilion_vault import PavilionVaultItem as PavilionVaultItem
from mbla.deck.items.polyhedron import PolyhedronItem as PolyhedronItem
from mbla.deck.items.spiral_stair import SpiralStairItem as SpiralStairItem
from mbla.deck.items.stack import StackItem as StackItem
from mbla.deck.items.table import TableItem as TableItem
from mbla.deck.items.trilithon import TrilithonItem as TrilithonItem
from mbla.deck.items.vault import VaultItem as VaultItem
from mbla.deck.items.wall import WallItem as WallItem
from mbla.deck.items.walls import CrossWall as CrossWall
from mbla.deck.items.walls import WallsItem as WallsItem
from mbla.deck.section import Section


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
