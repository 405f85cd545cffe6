"""Generator of blocks from a geometry file."""

from __future__ import annotations

from dataclasses import replace

from mbla.deck.types import MeshItem
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.geometry import read_geometry
from mbla.model.geometry.geometry import GeometryFileError
from mbla.model.geometry.repair import repair


def generate_mesh(item: MeshItem, site: Site) -> Generated:
    """Blocks in the order of the file, scaled about the origin.

    Raises
    ------
    ItemRefused
        for files that cannot be read, of an unknown kind, or without blocks
    DeckError
        for files that are missing or outside the deck's folder
    """
    path = site.resolve_file(("file",), item.file)
    try:
        geometry = repair(read_geometry(path), site.tolerance)
    except GeometryFileError as error:
        raise ItemRefused([(("file",), str(error))]) from error
    polyhedra = replace(geometry.polyhedra, vertices=geometry.polyhedra.vertices * item.scale)
    notices = tuple(replace(notice, message=f"{item.file}: {notice.message}") for notice in geometry.notices)
    return Generated((Part(polyhedra),), notices=notices)
