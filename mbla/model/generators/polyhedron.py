"""Generator of one explicit polyhedron."""

from __future__ import annotations

from mbla.deck.items.polyhedron import PolyhedronItem
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import polyhedra_from_lists


def generate_polyhedron(item: PolyhedronItem, site: Site) -> Generated:
    """The polyhedron as listed; faces in any orientation."""
    return Generated((Part(polyhedra_from_lists([item.vertices], [item.faces])),))
