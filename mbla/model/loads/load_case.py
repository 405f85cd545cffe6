"""Loads of a case as forces and moments on blocks, about their centroids: the sum of its single loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load, LoadCaseSection
from mbla.errors import Fault
from mbla.model.loads.kinds import LOAD_KINDS
from mbla.model.loads.load_kind import AppliedLoad, LoadSite
from mbla.model.model import LoadCase
from mbla.model.selectors import select_blocks

CANCELLED = 1e-12
"""sum of live loads, relative to the loads themselves, at which nothing is left of them"""
COMPUTABLE = (1e-100, 1e100)
"""largest load of a case, in units of force"""


@dataclass
class _Sum:
    """Loads added up: ``total`` (n_blocks, 6), ``gross`` (n_blocks, 6) without signs, and each in words."""

    total: FloatArray
    gross: FloatArray
    words: list[str] = field(default_factory=list)

    def add(self, applied: AppliedLoad) -> None:
        """One load more."""
        self.total[applied.blocks] += applied.wrenches
        self.gross[applied.blocks] += np.abs(applied.wrenches)
        self.words.append(applied.words)


def build_load_case(name: str, section: LoadCaseSection, site: LoadSite) -> LoadCase:
    """Dead and live load of one case; gravity of 9.81 m/s2 along -z is the dead load unless the deck gives one.

    Adds to ``site.faults`` what no load can be made of, and live loads without effect, which are those that act on
    fixed blocks only or cancel each other.
    """
    path: KeyPath = ("load_cases", name)
    dead_loads = section.dead
    if dead_loads is None:
        dead_loads = [Load.model_construct(gravity=(0.0, 0.0, -site.units.standard_gravity))]
    before = len(site.faults)
    dead = _add_up(dead_loads, (*path, "dead"), site, live=False)
    live = _add_up(section.live or [], (*path, "live"), site, live=True)
    free = ~site.fixed
    judged = len(site.faults) == before and free.any() and not site.roster.partial and section.live is not None
    rest = np.abs(live.total[free]).max(initial=0.0)
    if judged and rest <= CANCELLED * live.gross[free].max(initial=0.0):
        site.refuse((*path, "live"), "the live loads cancel each other: they have no effect")
    elif judged:
        site.faults.extend(_beyond_computing((*path, "live"), live.total[free], site))
        place = (*path, "dead") if section.dead is not None else path
        site.faults.extend(_beyond_computing(place, dead.total[free], site))
    return LoadCase(name, dead.total, live.total, tuple(dead.words), tuple(live.words))


def _beyond_computing(path: KeyPath, loads: FloatArray, site: LoadSite) -> list[Fault]:
    """Loads so small or so large that their squares leave the range of numbers."""
    largest = float(np.abs(loads).max(initial=0.0))
    least, most = COMPUTABLE
    if largest == 0.0 or least <= largest <= most:
        return []
    size = f"{largest:.1e} {site.units.force}"
    return [site.roster.fault_at(path, f"the loads reach {size}: {least:.0e} to {most:.0e} can be computed with")]


def _add_up(loads: Sequence[Load], path: KeyPath, site: LoadSite, live: bool) -> _Sum:
    shape = (len(site.fixed), 6)
    result = _Sum(np.zeros(shape), np.zeros(shape))
    for number, load in enumerate(loads):
        here = (*path, number)
        applied = _apply(load, here, site)
        if applied is not None:
            result.add(applied)
            _judge_fixed(load, applied, here, site, live)
    return result


def kind_of(load: Load) -> str:
    """The key that makes a load what it is; a rule of the deck: it has exactly one."""
    return next(kind for kind in LOAD_KINDS if getattr(load, kind) is not None)


def _apply(load: Load, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """One load on its blocks; None where a fault was left, or where blocks it depends on could not be built."""
    blocks = None
    if load.on is not None:
        blocks = select_blocks(load.on, (*path, "on"), site.roster, site.faults)
        if blocks is None:
            return None
    return LOAD_KINDS[kind_of(load)](load, blocks, path, site)


def _judge_fixed(load: Load, applied: AppliedLoad, path: KeyPath, site: LoadSite, live: bool) -> None:
    """A load on blocks that do not move goes straight into the support: no live load does that alone."""
    blocks = applied.blocks
    if not site.fixed[blocks].all() or site.fixed.all():  # a structure that is fixed altogether is refused as such
        return
    kind = kind_of(load)
    if live:
        key = "on" if load.on is not None else kind
        site.refuse((*path, key), "every block it acts on is fixed: the live load has no effect")
    elif kind not in ("gravity", "acceleration"):
        name = site.blocks.name(int(blocks[0])) + (f" and {len(blocks) - 1} more" if len(blocks) > 1 else "")
        moves = "does not move" if len(blocks) == 1 else "do not move"
        words = f"the dead {kind} on {name} goes straight into the support, for {name} {moves}"
        site.warn("dead-load-on-support", words)
