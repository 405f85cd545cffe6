"""Loads of a case as forces and moments on blocks, about their centroids: the sum of its single loads."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.load_key import LOAD_KEYS
from mbla.deck.sections.load_cases import LoadCaseSection, supports_of
from mbla.deck.sections.time_history import given_in_time
from mbla.errors import Finding, KeyPath
from mbla.model.applied_load import AppliedLoad, without_levers
from mbla.model.loads.gravity import gravity_of, with_gravity
from mbla.model.loads.load_kind import CaseKind, Entry, LoadSite, Variant, entries_of, load_kind
from mbla.model.model import LoadCase, Pushing
from mbla.model.motion.build import build_time_history
from mbla.model.motion.time_history import TimeHistory
from mbla.model.selectors import select_blocks
from mbla.model.solids.plane import unit
from mbla.model.wording import named, vector
from mbla.questions.modes import FirstPeriod
from mbla.questions.time_history import PeakDisplacement

CANCELLED = 1e-12
"""sum of loads, relative to the loads themselves, at which nothing is left of them but rounding"""
SAME_GRAVITY = 0.01
"""difference of gravity from the standard one, relative, that changes no stress of soil, as of 9.8 and 9.81"""
COMPUTABLE = (1e-100, 1e100)
"""largest load of a case, in units of force"""

STEPS_OF_SETTLEMENT, MOST_OF_SETTLEMENT = 50, 2000
"""steps of a settlement unless the deck says how long they are, and at most: each is shorter where blocks move far"""
GIVES = 1e-6
"""of the mean size of blocks, by which elastic joints of a pushover give: a step is longer"""


@dataclass(frozen=True)
class _Sum:
    """Loads added up: ``total`` (n_blocks, 15), ``gross`` (n_blocks, 15) without signs, and each of them.

    following : (n_blocks, 15) the part of the total that turns with the blocks, whose levers are not in the total
    complete  : none of them left a fault
    """

    total: FloatArray
    gross: FloatArray
    following: FloatArray
    loads: tuple[AppliedLoad, ...] = ()
    complete: bool = True

    @property
    def net(self) -> FloatArray:
        """Forces and moments, (n_blocks, 6); of what cancels no rounding is left, which nothing might carry."""
        cancels = np.isfinite(self.gross) & (np.abs(self.total) <= CANCELLED * self.gross)
        return np.where(cancels, 0.0, self.total)[:, :6]

    def plus(self, *loads: AppliedLoad | None) -> _Sum:
        """The same with more loads; None for those that left a fault."""
        total, gross, following = self.total.copy(), self.gross.copy(), self.following.copy()
        applied = [load for load in loads if load is not None]
        for load in applied:
            keeps = without_levers(load.wrenches[:, :6]) if load.follows else load.wrenches
            total[load.blocks] += keeps
            gross[load.blocks] += np.abs(keeps)
            following[load.blocks] += load.follows * load.wrenches
        return _Sum(total, gross, following, (*self.loads, *applied), self.complete and len(applied) == len(loads))


@np.errstate(over="ignore", invalid="ignore")  # loads beyond what a double holds are refused as such
def build_load_cases(name: str, section: LoadCaseSection, site: LoadSite) -> tuple[LoadCase, ...]:
    """Dead and live load of one case, or of one for each position of a load that travels.

    Gravity of 9.81 m/s2 along -z is one of the dead loads unless the deck gives another, or none. Refuses
    what no load can be made of, and live loads without effect, which are those that act on fixed
    blocks only or cancel each other.
    """
    path: KeyPath = ("load_cases", name)
    dead_loads = with_gravity(entries_of(section.dead or [], (*path, "dead"), site.named), path, site.units)
    before = len(site.selection.faults)
    dead = _add_up(dead_loads, site, live=False).plus(*site.water)
    live_loads = list(entries_of(section.live or [], (*path, "live"), site.named))
    live = _add_up(live_loads, site, live=True)
    variants = [_asked(section)]
    for entry in live_loads:
        if isinstance(kind := LOAD_KEYS[entry.kind], CaseKind):  # a rule of the deck: at most one is
            variants = kind.variants(name, entry, dead_loads, dead.net, site)
    _judge_soil(name, gravity_of(dead_loads), any(each.question.tilts for each in variants), site)
    sound = len(site.selection.faults) == before
    cases = []
    for variant in variants:
        place = variant.question.place
        own = live if variant.load is None else live.plus(variant.load)
        if len(site.selection.faults) == before and own.complete and section.live is not None:
            _judge_live(variant.load, path, own, site)
        asked = None if section.pushover is None else section.pushover.position
        case = LoadCase(
            name + place.suffix,
            dead.net,
            own.net,
            dead.loads,
            own.loads,
            question=variant.question,
            pushover=_pushing(name, section, dead, own, site) if asked in (None, place.number) else None,
            assessment=section.assessment,
            time_history=_in_time(name, section, dead, site),
            modes=section.modes or 0,
        )
        cases.append(case)
    if sound and dead.complete:
        _judge_size((*path, "dead") if section.dead is not None else path, dead, site)
    return tuple(cases)


def _judge_soil(name: str, gravity: FloatArray, tilts: bool, site: LoadSite) -> None:
    """Soil that holds faces, and water in it, are part of the structure: a warning where gravity of the case is not
    that of their stress.
    """
    soils = [body.name for body in site.fill.values() if body.passive is not None]
    usual = site.units.standard_gravity
    other = np.linalg.norm(gravity - np.array([0.0, 0.0, -usual])) > SAME_GRAVITY * usual
    why = "gravity turns against it" if tilts else f"gravity here is {vector(gravity)} {site.units.length}/s2"
    if site.water and (tilts or other):
        words = f"{name}: water in soil lifts it and presses on blocks as under standard gravity along -z, though {why}"
        site.warn("soil-stress-stays", f"{words}: leave out water for this load case")
    if soils and (tilts or other):
        words = (
            f"{name}: the fill {', '.join(soils)} pushes on faces as under standard gravity along -z, with the active "
            f"pressure at least, though {why}: leave out passive for this load case"
        )
        site.warn("soil-stress-stays", words)


def _asked(section: LoadCaseSection) -> Variant:
    """What a load case asks if its loads do not say."""
    if section.time_history is not None:
        return Variant(question=PeakDisplacement())
    return Variant(question=FirstPeriod()) if given_in_time(section) else Variant()


def _in_time(name: str, section: LoadCaseSection, dead: _Sum, site: LoadSite) -> TimeHistory | None:
    """The structure in time, with levers and following parts of the dead loads; None for nothing, or for a fault."""
    if section.time_history is None:
        return None
    return build_time_history(name, section.time_history, dead.total[:, 6:], dead.following[:, :6], site)


def _pushing(name: str, section: LoadCaseSection, dead: _Sum, live: _Sum, site: LoadSite) -> Pushing | None:
    """What is followed beyond the first movement, with levers and following parts of the loads; None for nothing.

    None, and a fault, where the blocks of the control point are not found; those of a settlement are not known yet.
    """
    asked, supports = section.pushover, supports_of(section)
    levers = (dead.total[:, 6:], live.total[:, 6:], dead.following[:, :6], live.following[:, :6], live.following[:, 6:])
    none = np.zeros(0, dtype=np.int64)
    blocks: IntArray | None = none
    amounts = [support.amount for support in supports if support.amount is not None]
    if amounts:
        farthest = max(amounts)
        steps = [each.step * farthest / each.amount for each in supports if each.step is not None and each.amount]
        step, error = (steps or [farthest / STEPS_OF_SETTLEMENT])[0], all(each.error for each in supports)
        _judge_step(step, _place_of_step(name, section), site)
        return Pushing(step, farthest, 0.0, MOST_OF_SETTLEMENT, none, np.full(3, np.nan), error, *levers)
    if asked is None:
        return None
    _judge_step(asked.step, ("load_cases", name, "pushover", "step"), site)
    if asked.control.on is not None:
        path: KeyPath = ("load_cases", name, "pushover", "control", "on")
        blocks = select_blocks(asked.control.on, path, site.selection)
    given_direction = asked.control.direction
    direction = np.full(3, np.nan) if given_direction is None else unit(np.array(given_direction))
    until = np.inf if asked.until is None else asked.until
    ends = until, asked.until_load_factor or 0.0, asked.steps
    return None if blocks is None else Pushing(asked.step, *ends, blocks, direction, asked.error, *levers)


def _judge_step(step: float, path: KeyPath, site: LoadSite) -> None:
    """A step is longer than what elastic joints give."""
    sizes = site.blocks.sizes[~site.fixed]
    least = GIVES * float(sizes.mean()) if len(sizes) else 0.0
    if step <= least and not site.selection.partial:
        of = "a millionth of the size of blocks, by which joints give"
        words = f"must be > {least:.2g} {site.units.length}, {of}"
        if path[-1] != "step":
            words = f"must be > {STEPS_OF_SETTLEMENT * least:.2g} {site.units.length}: a fiftieth of it is a step, "
            words += f"more than {of}"
        site.refuse(Finding("out-of-bounds", words, *path))


def _place_of_step(name: str, section: LoadCaseSection) -> KeyPath:
    """Where the step of a settlement is given, or the amount that it follows from."""
    supports, path = supports_of(section), ("load_cases", name, "settlement")
    number = next((row for row, each in enumerate(supports) if each.step is not None), 0)
    key = "amount" if supports[number].step is None else "step"
    return (*path, number, key) if isinstance(section.settlement, list) else (*path, key)


def _judge_live(travelling: AppliedLoad | None, path: KeyPath, live: _Sum, site: LoadSite) -> None:
    """Live loads must leave something on blocks that move, and be numbers to compute with."""
    free = ~site.fixed
    if not free.any() or site.selection.partial or _judge_size((*path, "live"), live, site):
        return
    if np.abs(live.net[free]).max() > CANCELLED * live.gross[free, :6].max():
        return
    words = "the live loads cancel each other: they have no effect"
    if travelling is not None and site.fixed[travelling.blocks].all():
        words = f"{travelling.words} has no effect: what it acts on does not move; change the path"
    site.refuse(Finding("live-load-without-effect", words, *path, "live"))


def _judge_size(path: KeyPath, loads: _Sum, site: LoadSite) -> bool:
    """Whether loads on blocks that move are so small or so large that their squares leave the range of numbers."""
    largest = float(loads.gross[~site.fixed, :6].max(initial=0.0))
    least, most = COMPUTABLE
    if site.selection.partial or largest == 0.0 or least <= largest <= most:
        return False
    size = f"{largest:.1e}" if np.isfinite(largest) else f"more than {np.finfo(np.float64).max:.1e}"
    words = f"the loads reach {size} {site.units.force}: {least:.0e} to {most:.0e} can be computed with"
    site.refuse(Finding("load-beyond-computing", words, *path))
    return True


def _add_up(entries: Iterable[Entry], site: LoadSite, live: bool) -> _Sum:
    nothing = np.zeros((len(site.fixed), 15))
    sums = [entry for entry in entries if entry.adds_up]
    return _Sum(nothing, nothing, nothing).plus(*(_apply(entry, site, live) for entry in sums))


def _apply(entry: Entry, site: LoadSite, live: bool) -> AppliedLoad | None:
    """One load on its blocks; None where a fault was left, or where blocks it depends on could not be built."""
    on, blocks = entry.load.on, None
    if on is not None:
        blocks = select_blocks(on, (*entry.path, "on"), site.selection)
        if blocks is None:
            return None
    applied = load_kind(entry).build(entry, blocks, site)
    if applied is None:
        return None
    if entry.factor != 1.0:
        applied = applied.times(entry.factor)
    applied = replace(applied, follows=entry.load.follows)
    _judge_effect(entry, applied, site, live)
    return applied


def _judge_effect(entry: Entry, applied: AppliedLoad, site: LoadSite, live: bool) -> None:
    """A live load must do something; on blocks that do not move any load goes straight into the support."""
    blocks, kind = applied.blocks, load_kind(entry)
    key = "on" if entry.load.on is not None else kind.name
    # what weighs nothing is refused as such, and rows of a table that cancel each other as live loads that do
    weightless = kind.may_cancel or (applied.on_masses and not site.blocks.masses[blocks].any())
    if live and not applied.wrenches.any() and not weightless:
        site.refuse(Finding("live-load-without-effect", "is a live load with no effect", *entry.path, kind.name))
    if not site.fixed[blocks].all() or site.fixed.all():  # a structure that is fixed altogether is refused as such
        return
    if live:
        words = "every block it acts on is fixed: the live load has no effect"
        site.refuse(Finding("live-load-without-effect", words, *entry.path, key))
    elif not applied.on_masses:
        name = named(blocks, site.blocks.name)
        moves = "does not move" if len(blocks) == 1 else "do not move"
        words = f"the dead {kind.name} on {name} goes straight into the support, for {name} {moves}"
        site.warn("dead-load-on-support", words)
