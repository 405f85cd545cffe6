"""Generators: each turns an item of the deck into raw polyhedra. A new one is a file and a name here.

The generator of an item ``wall`` is ``generate_wall`` in the file ``wall.py``. It is imported when an item asks for it:
all of them together take longer to import than a wall of a thousand blocks to generate.
"""

from __future__ import annotations

from importlib import import_module

from mbla.model.generators.generator import Generator

KINDS = (
    "box",
    "polyhedron",
    "wall",
    "walls",
    "arch",
    "mesh",
    "bridge",
    "table",
    "column",
    "stack",
    "trilithon",
    "dome",
    "barrel_vault",
    "cross_vault",
    "pavilion_vault",
    "spiral_stair",
)
"""keys of the items in the deck"""


def generator_of(kind: str) -> Generator:
    """The generator of items of one of ``KINDS``."""
    generator: Generator = getattr(import_module(f"mbla.model.generators.{kind}"), f"generate_{kind}")
    return generator
