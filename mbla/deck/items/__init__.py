"""The items of `blocks`: one file per kind. A new one is a file, a line here and a generator."""

from __future__ import annotations

from mbla.deck.items.arch import ArchItem as ArchItem
from mbla.deck.items.box import BoxItem as BoxItem
from mbla.deck.items.item import Item as Item
from mbla.deck.items.item import Reflection as Reflection
from mbla.deck.items.item import Repetition as Repetition
from mbla.deck.items.item import Rotation as Rotation
from mbla.deck.items.item import TransformStep as TransformStep
from mbla.deck.items.mesh import MeshItem as MeshItem
from mbla.deck.items.polyhedron import PolyhedronItem as PolyhedronItem
from mbla.deck.items.wall import Opening as Opening
from mbla.deck.items.wall import WallItem as WallItem
from mbla.deck.section import Section


class BlockItem(Section):
    """An item of `blocks`: exactly one key, its kind."""

    box: BoxItem | None = None
    polyhedron: PolyhedronItem | None = None
    wall: WallItem | None = None
    arch: ArchItem | None = None
    mesh: MeshItem | None = None
