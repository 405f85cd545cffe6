"""Modes of contact points and interfaces that are not the same in two mechanisms."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.collapse.interface_modes import InterfaceMode, interface_motion
from mbla.results.diff.matching import Matching, match_interfaces, match_points
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import ContactMode, Mechanics


@dataclass(frozen=True)
class InterfaceChange:
    """An interface with another mode: its bodies as A names them, centroid in A (3,), modes in A and in B."""

    bodies: str
    centroid: FloatArray
    modes: tuple[str, str]


@dataclass(frozen=True)
class ModeComparison:
    """What joints do.

    points     : contact points by (mode in A, mode in B) where these differ
    compared   : contact points and interfaces that both have
    only       : contact points of A alone and of B alone
    interfaces : every interface with another mode
    """

    points: dict[tuple[str, str], int]
    compared: tuple[int, int]
    only: tuple[int, int]
    interfaces: tuple[InterfaceChange, ...]


def compare_modes(
    first: Results,
    cases: tuple[CaseResult, CaseResult],
    second: Results,
    mechanics: tuple[Mechanics, Mechanics],
    matching: Matching,
    length: float,
) -> ModeComparison:
    """Modes of two mechanisms at the contacts that both have; ``length`` is B's unit in that of A."""
    sizes = first.model.blocks.sizes
    points = match_points(first.contacts, second.contacts, matching, sizes, length)
    there = points >= 0
    own, other = mechanics[0].modes[there], mechanics[1].modes[points[there]]
    differ = own != other
    counts = Counter(zip(own[differ].tolist(), other[differ].tolist(), strict=True))
    faces = match_interfaces(first.contacts, second.contacts, matching, sizes, length)
    return ModeComparison(
        points={(_word(ContactMode, a), _word(ContactMode, b)): count for (a, b), count in sorted(counts.items())},
        compared=(int(there.sum()), int((faces >= 0).sum())),
        only=(int((~there).sum()), len(second.contacts.points) - len(np.unique(points[there]))),
        interfaces=_interfaces(first, cases, second, mechanics, faces),
    )


def _interfaces(
    first: Results,
    cases: tuple[CaseResult, CaseResult],
    second: Results,
    mechanics: tuple[Mechanics, Mechanics],
    faces: IntArray,
) -> tuple[InterfaceChange, ...]:
    models = [results.model.of_case(case.load_case) for results, case in zip((first, second), cases, strict=True)]
    own = interface_motion(models[0], first.contacts, mechanics[0]).modes
    other = interface_motion(models[1], second.contacts, mechanics[1]).modes
    contacts, rows = first.contacts, np.flatnonzero(faces >= 0)
    return tuple(
        InterfaceChange(
            "/".join(first.model.body_name(int(body)) for body in contacts.bodies[row]),
            contacts.centroids[row],
            (_word(InterfaceMode, own[row]), _word(InterfaceMode, other[faces[row]])),
        )
        for row in rows[own[rows] != other[faces[rows]]]
    )


def _word(kind: type[ContactMode] | type[InterfaceMode], mode: int) -> str:
    return kind(int(mode)).name.lower()
