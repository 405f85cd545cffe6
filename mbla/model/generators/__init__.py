"""Generators: each turns an item of the deck into raw polyhedra. A new one is a file and a line here.

The generator of an item ``arch`` is ``generate_arch``. The file is imported when an item asks for it: all of them
together take longer to import than a wall of a thousand blocks to generate. How much items make is in ``amounts``.
"""

from __future__ import annotations

from importlib import import_module

from mbla.model.generators.generator import Generator

KINDS = {
    "box": "cuboids",
    "polyhedron": "cuboids",
    "wall": "walls",
    "walls": "walls",
    "arch": "arch",
    "mesh": "files",
    "bridge": "bridge",
    "table": "files",
    "column": "column",
    "stack": "cuboids",
    "trilithon": "cuboids",
    "dome": "dome",
    "barrel_vault": "arch",
    "cross_vault": "mitred_vaults",
    "pavilion_vault": "mitred_vaults",
    "spiral_stair": "spiral_stair",
}
"""keys of the items in the deck, and the file with the generator of each"""


def generator_of(kind: str) -> Generator:
    """The generator of items of one of ``KINDS``."""
    generator: Generator = getattr(import_module(f"mbla.model.generators.{KINDS[kind]}"), f"generate_{kind}")
    return generator
