"""All mutants, each from a seed of its own, which its name gives."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from tests.trust.geometry.formats import FORMATS, Files, Format
from tests.trust.geometry.shapes import EITHER, MUTATIONS, SAME, Expect
from tests.trust.geometry.stones import arch
from tests.trust.geometry.texts import (
    COORDINATES,
    CORNERS,
    TEXT_FAULTS,
    mark_coordinate,
    mark_corner,
    with_number,
)


@dataclass(frozen=True)
class Mutant:
    """A broken file: its format, what was done, and what must come of it (see ``shapes.Mutation``)."""

    kind: Format
    name: str
    files: Files
    expect: Expect
    told: frozenset[str] = frozenset()
    tolerance: float = 1e-6
    scale: float = 1.0

    @property
    def title(self) -> str:
        """``obj: face missing``."""
        return f"{self.kind.name}: {self.name}"


@cache
def mutants() -> tuple[Mutant, ...]:
    """Every mutant of every format."""
    return tuple(_mutants())


def _mutants() -> Iterator[Mutant]:
    for kind in FORMATS.values():
        yield from _of_shapes(kind)
        yield from _of_texts(kind)
        yield from _of_numbers(kind)


def _random(*words: str) -> np.random.Generator:
    return np.random.default_rng(zlib.crc32(" ".join(words).encode()))


def _of_shapes(kind: Format) -> Iterator[Mutant]:
    for mutation in MUTATIONS:
        if not mutation.suits(kind):
            continue
        stones = mutation.change(arch(), _random(kind.name, mutation.name))
        # where all blocks are one surface, faces that do not fit may leave open which belong together; tables are
        # written for this program, and nothing in them is mended but the sides of faces
        expect = EITHER if mutation.expect is SAME and not (kind.apart and kind.mended) else mutation.expect
        files = kind.write(stones)
        yield Mutant(kind, mutation.name, files, expect, mutation.told, mutation.tolerance, mutation.scale)


def _of_texts(kind: Format) -> Iterator[Mutant]:
    files = kind.write(arch())
    name = next(iter(files))
    for fault in TEXT_FAULTS:
        for number in range(fault.times if fault.suits(kind) else 0):
            called = f"{fault.name} ({number + 1})" if fault.times > 1 else fault.name
            damaged = fault.damage(files[name], _random(kind.name, called))
            yield Mutant(kind, called, {**files, name: damaged}, fault.expect, fault.told)


def _of_numbers(kind: Format) -> Iterator[Mutant]:
    if kind.binary:
        return
    files = kind.write(arch())
    for what, mark, faults in (("coordinate", mark_coordinate, COORDINATES), ("corner", mark_corner, CORNERS)):
        for fault in faults:
            title = f"{what} spelt {fault.spelt or 'as nothing'}"
            marked = kind.write(mark(arch(), _random(kind.name, title)))
            damaged = with_number(files, marked, fault)
            if damaged is not None:
                yield Mutant(kind, title, damaged, fault.expect)
