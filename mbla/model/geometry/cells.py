"""Volume cells of mesh files by their faces; types carry the names that meshio gives them."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.model.solids.polyhedra import HEXAHEDRON

VOLUME_CELLS: dict[str, tuple[int, Sequence[Sequence[int]]]] = {
    "tetra": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "VTK_LAGRANGE_TETRAHEDRON": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "hexahedron": (8, HEXAHEDRON),
    "VTK_LAGRANGE_HEXAHEDRON": (8, HEXAHEDRON),
    "wedge": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "VTK_LAGRANGE_WEDGE": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "pyramid": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
    "VTK_LAGRANGE_PYRAMID": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
    "penta_prism": (
        10,
        ((4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *((i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5) for i in range(5))),
    ),
    "hexa_prism": (
        12,
        ((5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))),
    ),
}
"""number of corners and faces by corner, of each shape of cell; cells of higher order begin with their corners"""
