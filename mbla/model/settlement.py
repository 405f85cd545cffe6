"""Settlement of a support, as a load case: which blocks give way, how, and the loads that hold and take their reaction.

Limit analysis of settlements: as a support gives way its reaction falls to the least value that equilibrium allows, and
the structure moves in the mechanism that belongs to it (Heyman 1966, doi:10.1016/0020-7683(66)90018-7; Portioli and
Cascini 2017, Engineering Structures 148, 485-496). With the velocities of the settling blocks w_b = q m_b for one
unknown q, the reaction R of the support against the motion balances what the structure does to them::

    R = Σ_b m_bᵀ f_b,       f_b : contact forces on b

Posed with a load factor: R = R0 − λ U with R0 a reaction with which the structure is at rest, and U the weight of what
can move. The greatest λ gives the least R. Loads on the settling blocks themselves are not part of R.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.load_cases import SettlementSection
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.guides import slide, turn
from mbla.model.model import LoadCase, Settlement
from mbla.model.selectors import Roster, select_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.supports import Supports
from mbla.model.wording import counted, named, vector


def build_settlement(
    section: SettlementSection,
    path: KeyPath,
    load_case: LoadCase,
    supports: Supports,
    roster: Roster,
) -> LoadCase:
    """The load case with its settlement; the reference reaction is not known before there are contacts.

    Refuses blocks that `supports` does not fix, and settlements under no dead load or of everything fixed.
    """
    chosen = select_blocks(section.on, (*path, "on"), roster)
    if chosen is None:
        return load_case
    loose = chosen[~supports.fixed[chosen]]
    if len(loose):
        message = (
            f"not fixed: {named(loose, roster.blocks.name)}; a support that gives way is made of blocks that "
            "`supports` fixes; in place of a ground plane give a block and fix it"
        )
        roster.refuse(Finding("settlement-not-fixed", message, *path, "on"))
        return load_case
    free = ~supports.fixed
    size = size_of_loads(load_case.dead_load, roster.blocks, free)
    if not np.isfinite(size):
        return load_case  # refused as loads beyond computing
    if not size > 0.0:
        if free.any() and not roster.partial:
            message = "there is no dead load on blocks that can move, or all of it cancels: no reaction is lost"
            roster.refuse(Finding("settlement-without-effect", message, *path))
        return load_case
    motions, words = _motion(section, chosen, roster.blocks)
    if section.turn is not None:
        size *= _distance_from(section, roster.blocks.centroids[free])
    settlement = Settlement(chosen, motions, section.turn is not None, words, np.nan, size)
    pushover = load_case.pushover
    if pushover is not None and section.direction is not None:
        levers = pushover.dead_levers.copy()
        levers[chosen] = 0.0  # the reaction acts on their centroids
        pushover = replace(pushover, blocks=chosen, direction=unit(section.direction), dead_levers=levers)
    return with_reference(replace(load_case, settlement=settlement, pushover=pushover), np.nan)


def size_of_loads(loads: FloatArray, blocks: Blocks, chosen: BoolArray) -> float:
    """Sum of the forces on blocks; without any that of the moments about their centroids over sizes; from (n, 6)."""
    with np.errstate(over="ignore", invalid="ignore"):
        forces, moments = (np.linalg.norm(part[chosen], axis=1) for part in np.split(loads, 2, axis=1))
        return float(forces.sum() or (moments / blocks.sizes[chosen]).sum())


def with_reference(load_case: LoadCase, reference: float) -> LoadCase:
    """The load case with the reaction of the structure at rest, which is its dead load on the settling blocks."""
    settlement = load_case.settlement
    assert settlement is not None
    per_unit = _forces_of_unit_reaction(settlement)
    dead, live = load_case.dead_load.copy(), np.zeros_like(load_case.dead_load)
    live[settlement.blocks] = settlement.unit * per_unit
    dead[settlement.blocks] = 0.0 if np.isnan(reference) else -reference * per_unit
    words = (settlement.words,)
    return replace(
        load_case,
        dead_load=dead,
        live_load=live,
        live_words=words,
        settlement=replace(settlement, reference=reference),
    )


def _forces_of_unit_reaction(settlement: Settlement) -> FloatArray:
    """Forces, or moments, in equal shares on the blocks, that do unit work in the unit motion, (m, 6)."""
    part = slice(3, 6) if settlement.turns else slice(0, 3)
    forces = np.zeros_like(settlement.motions)
    forces[:, part] = settlement.motions[:, part] / len(settlement.blocks)
    return forces


def _motion(section: SettlementSection, chosen: IntArray, blocks: Blocks) -> tuple[FloatArray, str]:
    subject = f"prescribed settlement of {counted(len(chosen), 'block')}"
    if section.direction is not None:
        return slide(unit(section.direction), len(chosen)), f"{subject} along {vector(section.direction)}"
    assert section.turn is not None  # a rule of the deck: a direction, or a line to turn about
    axis, about = section.turn.axis, section.turn.about
    words = f"{subject} turning about {vector(axis)} through {vector(about)}"
    return turn(unit(axis), np.array(about), blocks.centroids[chosen]), words


def _distance_from(section: SettlementSection, points: FloatArray) -> float:
    """Mean distance of points from the axis of rotation; the extent of the points where they lie on it."""
    assert section.turn is not None
    away = np.cross(unit(section.turn.axis), points - np.array(section.turn.about))
    mean = float(np.linalg.norm(away, axis=1).mean())
    return mean if mean > 0.0 else float(np.ptp(points, axis=0).max(initial=0.0)) or 1.0
