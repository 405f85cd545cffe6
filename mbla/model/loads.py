"""Loads of a case as forces and moments on blocks, about their centroids.

Gravity g and acceleration a act on the mass m of a block at its centroid, F = m g; a force F at a point p of a block
with centroid x brings the moment (p - x) x F.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import Load, LoadCaseSection
from mbla.deck.units import Units
from mbla.errors import Fault, Notice
from mbla.model.model import LoadCase
from mbla.model.selectors import Roster, select_blocks
from mbla.model.wording import counted, vector

OUTSIDE = 0.01
"""distance of a force from the bounding box of its block, relative to the diagonal, from which it is remarked on"""
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


@dataclass(frozen=True)
class LoadSite:
    """What loads act on: blocks to choose from, those that do not move, and the deck's units."""

    roster: Roster
    fixed: BoolArray
    units: Units


def build_load_case(
    name: str, section: LoadCaseSection, site: LoadSite, faults: list[Fault], notices: list[Notice]
) -> LoadCase:
    """Dead and live load of one case; gravity of 9.81 m/s2 along -z is the dead load unless the deck gives one.

    Adds to ``faults``: forces on other than one block, and live loads without effect, which are those that act on
    fixed blocks only or cancel each other.
    """
    path: KeyPath = ("load_cases", name)
    dead_loads = section.dead
    if dead_loads is None:
        dead_loads = [Load.model_construct(gravity=(0.0, 0.0, -site.units.standard_gravity))]
    before = len(faults)
    dead = _add_up(dead_loads, (*path, "dead"), site, faults, notices, live=False)
    live = _add_up(section.live or [], (*path, "live"), site, faults, notices, live=True)
    free = ~site.fixed
    judged = len(faults) == before and free.any() and not site.roster.partial and section.live is not None
    rest = np.abs(live.total[free]).max(initial=0.0)
    if judged and rest <= CANCELLED * live.gross[free].max(initial=0.0):
        faults.append(site.roster.fault_at((*path, "live"), "the live loads cancel each other: they have no effect"))
    elif judged:
        faults += _beyond_computing((*path, "live"), live.total[free], site)
        faults += _beyond_computing((*path, "dead") if section.dead is not None else path, dead.total[free], site)
    return LoadCase(name, dead.total, live.total, tuple(dead.words), tuple(live.words))


def _beyond_computing(path: KeyPath, loads: FloatArray, site: LoadSite) -> list[Fault]:
    """Loads so small or so large that their squares leave the range of numbers."""
    largest = float(np.abs(loads).max(initial=0.0))
    least, most = COMPUTABLE
    if largest == 0.0 or least <= largest <= most:
        return []
    size = f"{largest:.1e} {site.units.force}"
    return [site.roster.fault_at(path, f"the loads reach {size}: {least:.0e} to {most:.0e} can be computed with")]


def _add_up(
    loads: Sequence[Load], path: KeyPath, site: LoadSite, faults: list[Fault], notices: list[Notice], live: bool
) -> _Sum:
    shape = (len(site.fixed), 6)
    result = _Sum(np.zeros(shape), np.zeros(shape))
    for number, load in enumerate(loads):
        here = (*path, number)
        blocks = np.arange(len(site.fixed))
        if load.on is not None:
            chosen = select_blocks(load.on, (*here, "on"), site.roster, faults)
            if chosen is None:
                continue
            blocks = chosen
        if load.force is not None:
            if len(blocks) != 1:
                message = f"a force acts on one block, {len(blocks)} are selected: give an index, or one force for each"
                faults.append(site.roster.fault_at((*here, "on"), message))
                continue
            _add_force(load, int(blocks[0]), site, result, notices)
        else:
            _add_acceleration(load, blocks, site, result)
        _judge_fixed(load, blocks, here, site, faults, notices, live)
    return result


def _judge_fixed(
    load: Load,
    blocks: IntArray,
    path: KeyPath,
    site: LoadSite,
    faults: list[Fault],
    notices: list[Notice],
    live: bool,
) -> None:
    """A load on blocks that do not move goes straight into the support: no live load does that alone."""
    if not site.fixed[blocks].all() or site.fixed.all():  # a structure that is fixed altogether is refused as such
        return
    if live:
        key = "on" if load.on is not None else "acceleration"
        message = "every block it acts on is fixed: the live load has no effect"
        faults.append(site.roster.fault_at((*path, key), message))
    elif load.force is not None:
        name = site.roster.blocks.name(int(blocks[0]))
        words = f"the dead force on {name} goes straight into the support, for {name} does not move"
        notices.append(Notice("warning", "dead-load-on-support", words))


def _add_acceleration(load: Load, blocks: IntArray, site: LoadSite, result: _Sum) -> None:
    """Mass times gravity, or times acceleration in units of g, at the centroids."""
    units = site.units
    everywhere = len(blocks) == len(site.fixed)
    where = "" if everywhere else f" on {counted(len(blocks), 'block')}"
    if load.gravity is not None:
        acceleration = np.array(load.gravity)
        result.words.append(f"gravity {vector(load.gravity)} {units.length}/s2")
    else:
        assert load.acceleration is not None  # a rule of the deck: one of gravity, acceleration, force
        acceleration = np.array(load.acceleration) * units.standard_gravity
        result.words.append(f"acceleration {vector(load.acceleration)} g{where}")
    masses = site.roster.blocks.masses[blocks]
    forces = masses[:, None] * acceleration * units.force_per_mass_acceleration
    result.total[blocks, :3] += forces
    result.gross[blocks, :3] += np.abs(forces)


def _add_force(load: Load, block: int, site: LoadSite, result: _Sum, notices: list[Notice]) -> None:
    """A force at a point of a block, at its centroid unless given, with its moment about the centroid."""
    assert load.force is not None
    blocks = site.roster.blocks
    force = np.array(load.force)
    words = f"force {vector(load.force)} {site.units.force} on {blocks.name(block)}"
    wrench = np.concatenate([force, np.zeros(3)])
    if load.at is not None:
        point = np.array(load.at)
        wrench[3:] = np.cross(point - blocks.centroids[block], force)
        words += f" at {vector(load.at)} {site.units.length}"
        _remark_outside(block, point, words, site, notices)
    else:
        words += " at its centroid"
    result.words.append(words)
    result.total[block] += wrench
    result.gross[block] += np.abs(wrench)


def _remark_outside(block: int, point: FloatArray, words: str, site: LoadSite, notices: list[Notice]) -> None:
    blocks = site.roster.blocks
    vertices = blocks.vertices[blocks.vertex_start[block] : blocks.vertex_start[block + 1]]
    least, greatest = vertices.min(axis=0), vertices.max(axis=0)
    off = float(np.linalg.norm(np.maximum(0.0, np.maximum(least - point, point - greatest))))
    if off > OUTSIDE * float(np.linalg.norm(greatest - least)):
        message = f"the {words} acts {off:.4g} {site.units.length} outside that block; its moment is kept"
        notice = Notice("warning", "force-outside-block", message)
        if notice not in notices:
            notices.append(notice)
