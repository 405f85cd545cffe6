"""Other mechanics: joints, contacts and supports that admit more or fewer forces, or leave all as it was."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.assembly import assembly_of
from mbla.assembly.findings import settlement_findings
from tests.properties.additions import movable, split_in_two
from tests.properties.restatements import taken
from tests.properties.scenes import Scene, Solved, with_analysis, with_section


def open_an_interface(scene: Scene, solved: Solved) -> Scene | None:
    """One interface less, a random one."""
    if len(solved.contacts) < 2 or scene.model.mirrors:
        return None
    lost = int(np.random.default_rng(11).integers(len(solved.contacts)))
    return replace(scene, change=lambda contacts: taken(contacts, np.delete(np.arange(len(contacts)), lost)))


def strengthless(scene: Scene, solved: Solved) -> bool:
    """No joint in use has cohesion, tensile or limited compressive strength."""
    used = [scene.model.joints[name] for name in solved.contacts.joint_names if name in scene.model.joints]
    return not any(j.cohesion or j.tensile_strength or np.isfinite(j.compressive_strength) for j in used)


def refine(*, strengths: bool) -> Callable[[Scene, Solved], Scene | None]:
    """Edges in two parts, points inside; where joints have strengths, or where none has."""

    def make(scene: Scene, solved: Solved) -> Scene | None:
        points = scene.deck.contacts.points
        if scene.deck.analysis.contact_model == "convex" or points.spacing is not None or scene.model.mirrors:
            return None
        if strengthless(scene, solved) == strengths:
            return None
        return with_section(scene, points=points.model_copy(update={"per_edge": 2 * (points.per_edge or 1)}))

    return make


def split(askew: float) -> Callable[[Scene, Solved], Scene | None]:
    """One block as two that are glued; not where the division of an interface changes what it bears."""

    def make(scene: Scene, solved: Solved) -> Scene | None:
        points = scene.deck.contacts.points
        if scene.deck.analysis.contact_model == "convex" or not strengthless(scene, solved):
            return None
        if points.inset or points.rounding:
            return None
        return split_in_two(scene, askew)

    return make


def with_joints(change: Callable[..., dict[str, Any]]) -> Callable[[Scene, Solved], Scene | None]:
    """Other joint laws; ``change`` gets the law and the mean stress in the joints."""

    def make(scene: Scene, solved: Solved) -> Scene | None:
        loads = np.linalg.norm(scene.model.load_cases[0].dead_load[:, :3], axis=1)
        if not len(solved.contacts) or not scene.model.joints:
            return None
        stress = float(loads.mean() / solved.contacts.areas.mean()) or 1.0
        joints = {name: replace(joint, **change(joint, stress)) for name, joint in scene.model.joints.items()}
        return replace(scene, model=replace(scene.model, joints=joints))

    return make


def fix_a_block(scene: Scene, solved: Solved) -> Scene | None:
    """One free block more that does not move, a random one; not where glue would hold others with it."""
    model = scene.model
    if solved.contacts.solid_of_block is not None:
        return None
    free = np.sort(movable(model))
    if len(free) < 2 or model.mirrors:
        return None
    block = int(np.random.default_rng(13).choice(free))
    fixed = model.fixed.copy()
    fixed[block] = True
    rest = ~fixed
    loaded = [case for case in model.load_cases if case.question.multiplies]
    if not all(np.abs(case.live_load[rest]).max(initial=0.0) > 0 for case in loaded):
        return None
    model = replace(model, fixed=fixed)
    if any(settlement_findings(assembly_of(model, solved.contacts))):  # the support that gives way holds nothing else
        return None
    return replace(scene, model=model)


def convex_model(scene: Scene, _: Solved) -> Scene | None:
    """Conditions on resultants beside those on points."""
    points = scene.deck.contacts.points
    if scene.deck.analysis.contact_model == "convex" or points != type(points)():
        return None
    return with_analysis(scene, contact_model="convex")
