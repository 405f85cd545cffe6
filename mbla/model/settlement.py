"""Settlement of a support, as a load case: which blocks give way, how, and the loads that hold and take their reaction.

Limit analysis of settlements: as a support settles its reaction falls to the least value that equilibrium allows, and
the structure moves in the mechanism that belongs to it (Heyman 1966, doi:10.1016/0020-7683(66)90018-7; Portioli and
Cascini 2017, Engineering Structures 148, 485-496). With the velocities of the settling blocks w_b = q m_b for one
unknown q, the reaction R of the support against the motion balances what the structure does to them::

    R = Σ_b m_bᵀ f_b,       f_b : contact forces on b

Posed with a load factor: R = R0 − λ U with R0 a reaction with which the structure is at rest, and U the weight of what
can move. The greatest λ gives the least R. Loads on the settling blocks themselves are not part of R.

Several supports that settle together by amounts a_i along unit directions d_i are one motion, m_b = d_i a_i / max a:
q is the displacement of the one that goes farthest, and R = Σ_i R_i a_i / max a is conjugate to it, R_i the reaction of
each against its direction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.load_cases import LoadCaseSection, SettlementSection, supports_of
from mbla.errors import Finding, KeyPath
from mbla.model.applied_load import AppliedLoad, without_levers
from mbla.model.model import LoadCase
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.supports.guides import slide, turn
from mbla.model.supports.supports import Supports
from mbla.model.wording import counted, named, vector
from mbla.questions.reaction import Reaction, Settlement


def build_settlement(
    section: LoadCaseSection, path: KeyPath, load_case: LoadCase, supports: Supports, selection: BlockSelection
) -> LoadCase:
    """The load case with its settlement; the reference reaction is not known before there are contacts.

    Refuses blocks that `supports` does not fix or that give way twice, and settlements under no dead load or of
    everything fixed.
    """
    giving = _giving_way(section, path, supports, selection)
    if giving is None:
        return load_case
    free = ~supports.fixed
    size = size_of_loads(load_case.dead_load, selection.blocks, free)
    if not np.isfinite(size):
        return load_case  # refused as loads beyond computing
    if not size > 0.0:
        if free.any() and not selection.partial:
            message = "there is no dead load on blocks that can move, or all of it cancels: no reaction is lost"
            selection.refuse(Finding("settlement-without-effect", message, *path, "settlement"))
        return load_case
    parts = [_motion(support, chosen, selection.blocks) for support, chosen in giving]
    shares = _shares([support for support, _ in giving])
    blocks = np.concatenate([chosen for _, chosen in giving])
    order = np.argsort(blocks)
    motions = np.vstack([share * motions for share, (motions, _) in zip(shares, parts, strict=True)])[order]
    farthest, chosen = giving[int(np.argmax(shares))]
    if farthest.turn is not None:
        size *= _distance_from(farthest, selection.blocks.centroids[free])
    words = _words(giving, [each for _, each in parts])
    settlement = Settlement(blocks[order], motions, farthest.turn is not None, words, np.nan, size)
    pushover = load_case.pushover
    if pushover is not None and farthest.direction is not None:
        levers = pushover.dead_levers.copy()
        levers[blocks] = 0.0  # the reaction acts on their centroids
        pushover = replace(pushover, blocks=chosen, direction=unit(farthest.direction), dead_levers=levers)
    return with_reference(replace(load_case, question=Reaction(settlement), pushover=pushover), np.nan)


def _giving_way(
    section: LoadCaseSection, path: KeyPath, supports: Supports, selection: BlockSelection
) -> list[tuple[SettlementSection, IntArray]] | None:
    """Supports with their blocks; None where a fault was left."""
    found: list[tuple[SettlementSection, IntArray]] = []
    settles: KeyPath = (*path, "settlement")
    owner = dict[int, int]()
    for number, support in enumerate(supports_of(section)):
        place: KeyPath = (*settles, number, "on") if isinstance(section.settlement, list) else (*settles, "on")
        chosen = select_blocks(support.on, place, selection)
        if chosen is None:
            return None
        loose = chosen[~supports.fixed[chosen]]
        if len(loose):
            message = (
                f"not fixed: {named(loose, selection.blocks.name)}; a settling support is made of blocks that "
                "`supports` fixes; in place of a ground plane give a block and fix it"
            )
            selection.refuse(Finding("settlement-not-fixed", message, *place))
            return None
        twice = np.array([block for block in chosen if int(block) in owner], dtype=np.int64)
        if len(twice):
            names = named(twice, selection.blocks.name)
            message = f"{names}: settlement[{owner[int(twice[0])]}] moves that already; a support gives way in one way"
            selection.refuse(Finding("settlement-twice", message, *place))
            return None
        owner |= {int(block): number for block in chosen}
        found.append((support, chosen))
    return found


def _shares(supports: Sequence[SettlementSection]) -> list[float]:
    """How far each goes over the one that goes farthest; as far without amounts."""
    amounts = [1.0 if support.amount is None else support.amount for support in supports]
    return [amount / max(amounts) for amount in amounts]


def _words(giving: Sequence[tuple[SettlementSection, IntArray]], ways: Sequence[str]) -> str:
    """Which supports give way, and what their reaction is where they are several."""
    each = [f"{counted(len(chosen), 'block')} {way}" for (_, chosen), way in zip(giving, ways, strict=True)]
    several = len(giving) > 1
    if several:
        amounts = [support.amount for support, _ in giving]
        each = [way if amount is None else f"{way} by {amount:.6g}" for way, amount in zip(each, amounts, strict=True)]
    words = f"prescribed settlement of {', and of '.join(each)}"
    if several:
        words += "; the reaction is the sum of theirs, each times its amount over the greatest"
    return words


def size_of_loads(loads: FloatArray, blocks: Blocks, chosen: BoolArray) -> float:
    """Sum of the forces on blocks; without any that of the moments about their centroids over sizes; from (n, 6)."""
    with np.errstate(over="ignore", invalid="ignore"):
        forces, moments = (np.linalg.norm(part[chosen], axis=1) for part in np.split(loads, 2, axis=1))
        return float(forces.sum() or (moments / blocks.sizes[chosen]).sum())


def with_reference(load_case: LoadCase, reference: float) -> LoadCase:
    """The load case with the reaction of the structure at rest, which is its dead load on the settling blocks."""
    question = load_case.question
    assert isinstance(question, Reaction)
    settlement = question.settlement
    per_unit = _forces_of_unit_reaction(settlement)
    dead, live = load_case.dead_load.copy(), np.zeros_like(load_case.dead_load)
    live[settlement.blocks] = settlement.unit * per_unit
    dead[settlement.blocks] = 0.0 if np.isnan(reference) else -reference * per_unit
    pull = AppliedLoad(settlement.blocks, without_levers(live[settlement.blocks]), settlement.words)
    return replace(
        load_case,
        dead_load=dead,
        live_load=live,
        live=(pull,),
        question=replace(question, settlement=replace(settlement, reference=reference)),
    )


def _forces_of_unit_reaction(settlement: Settlement) -> FloatArray:
    """Forces, or moments, on the blocks as they move, that do unit work in the unit motion, (m, 6)."""
    part = slice(3, 6) if settlement.turns else slice(0, 3)
    forces = np.zeros_like(settlement.motions)
    forces[:, part] = settlement.motions[:, part] / (settlement.motions[:, part] ** 2).sum()
    return forces


def _motion(section: SettlementSection, chosen: IntArray, blocks: Blocks) -> tuple[FloatArray, str]:
    if section.direction is not None:
        return slide(unit(section.direction), len(chosen)), f"along {vector(section.direction)}"
    assert section.turn is not None  # a rule of the deck: a direction, or a line to turn about
    axis, about = section.turn.axis, section.turn.about
    words = f"turning about {vector(axis)} through {vector(about)}"
    return turn(unit(axis), np.array(about), blocks.centroids[chosen]), words


def _distance_from(section: SettlementSection, points: FloatArray) -> float:
    """Mean distance of points from the axis of rotation; the extent of the points where they lie on it."""
    assert section.turn is not None
    away = np.cross(unit(section.turn.axis), points - np.array(section.turn.about))
    mean = float(np.linalg.norm(away, axis=1).mean())
    return mean if mean > 0.0 else float(np.ptp(points, axis=0).max(initial=0.0)) or 1.0
