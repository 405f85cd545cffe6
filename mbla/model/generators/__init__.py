"""Generators: each turns an item of the deck into raw polyhedra. A new one is a file and a line here."""

from __future__ import annotations

from mbla.model.generators.arch import generate_arch
from mbla.model.generators.barrel_vault import generate_barrel_vault
from mbla.model.generators.box import generate_box
from mbla.model.generators.bridge import generate_bridge
from mbla.model.generators.column import generate_column
from mbla.model.generators.cross_vault import generate_cross_vault
from mbla.model.generators.dome import generate_dome
from mbla.model.generators.generator import Generator
from mbla.model.generators.mesh import generate_mesh
from mbla.model.generators.pavilion_vault import generate_pavilion_vault
from mbla.model.generators.polyhedron import generate_polyhedron
from mbla.model.generators.spiral_stair import generate_spiral_stair
from mbla.model.generators.stack import generate_stack
from mbla.model.generators.table import generate_table
from mbla.model.generators.trilithon import generate_trilithon
from mbla.model.generators.wall import generate_wall
from mbla.model.generators.walls import generate_walls

GENERATORS: dict[str, Generator] = {
    "box": generate_box,
    "polyhedron": generate_polyhedron,
    "wall": generate_wall,
    "walls": generate_walls,
    "arch": generate_arch,
    "mesh": generate_mesh,
    "bridge": generate_bridge,
    "table": generate_table,
    "column": generate_column,
    "stack": generate_stack,
    "trilithon": generate_trilithon,
    "dome": generate_dome,
    "barrel_vault": generate_barrel_vault,
    "cross_vault": generate_cross_vault,
    "pavilion_vault": generate_pavilion_vault,
    "spiral_stair": generate_spiral_stair,
}
"""by the key of the item in the deck"""
