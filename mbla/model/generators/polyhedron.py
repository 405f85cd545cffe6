"""Generator of one explicit polyhedron."""

from __future__ import annotations

from mbla.deck.types import PolyhedronItem
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.polyhedra import polyhedra_from_lists


def generate_polyhedron(item: PolyhedronItem, site: Site) -> Generated:
    """The polyhedron as listed; faces in any orientation.

    Raises
    ------
    ItemRefused
        where a face names a vertex that is not listed
    """
    count = len(item.vertices)
    if max(map(max, item.faces)) >= count:
        raise ItemRefused(
            [
                (("faces", number, position), f"there is no such vertex: {count} are listed, 0 to {count - 1}")
                for number, face in enumerate(item.faces)
                for position, vertex in enumerate(face)
                if vertex >= count
            ]
        )
    return Generated((Part(polyhedra_from_lists([item.vertices], [item.faces])),))
