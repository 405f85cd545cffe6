"""Generators: each turns an item of the deck into raw polyhedra. A new one is a file and a line here.

The generator of an item ``arch`` is ``generate_arch``; beside it ``amount_arch`` says about how much it will make,
where a few lines of a deck can ask for much. The file is imported when an item asks for it: all of them together take
longer to import than a wall of a thousand blocks to generate.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from mbla.deck.items.item import Item
from mbla.model.generators.amounts import Amount
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


def amount_of(kind: str, item: Item) -> Amount:
    """About how much an item of one of ``KINDS`` makes; a block where its generator does not say."""
    module = import_module(f"mbla.model.generators.{KINDS[kind]}")
    amount: Callable[[Item], Amount] = getattr(module, f"amount_{kind}", lambda item: Amount(1))
    return amount(item)
