"""What keeps a plane of symmetry from mirroring a model."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.deck.deck import Deck
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.errors import Finding, KeyPath
from mbla.model.loads.gravity import with_gravity
from mbla.model.loads.load_kind import entries_of, load_kind
from mbla.model.model import LoadCase, Model
from mbla.model.motion.time_history import TimeHistory
from mbla.model.symmetry.mirror import ACROSS, UNNAMED, ModelMirror
from mbla.model.wording import named
from mbla.questions.force import Objective


def loads_across(deck: Deck, section: LoadCaseSection, path: KeyPath, mirror: ModelMirror) -> Iterator[Finding]:
    """Loads on masses that are not their own mirror image, and kinds of loads that have no image."""
    dead = entries_of(section.dead or [], (*path, "dead"), deck.content.loads)
    live = entries_of(section.live or [], (*path, "live"), deck.content.loads)
    for entry in (*with_gravity(dead, path, deck.units), *live):
        kind = load_kind(entry) if entry.adds_up else None
        if entry.load.through is not None:
            message = "a load that spreads in fill may do so across a plane of symmetry: give the whole structure"
            yield Finding("symmetry-broken", message, *entry.path, "through")
        if kind is not None and kind.mirrored:
            continue
        message = f"is no load that can be mirrored about {mirror.label}: give the whole structure"
        if kind is not None and kind.vector is not None:
            value = np.array(kind.vector(entry.value))
            if abs(float(value @ mirror.normal)) <= ACROSS * np.abs(value).max():
                continue
            plane = mirror.label if mirror.label == UNNAMED else f"{UNNAMED} {mirror.label}"
            message = (
                f"acts across {plane}: the other half would have to be pushed the other way; give the whole structure"
            )
        yield Finding("symmetry-broken", message, *entry.path, entry.kind)


def cannot_mirror(deck: Deck, model: Model, mirror: ModelMirror, path: KeyPath) -> Iterator[Finding]:
    """Supports and forces that have no image."""
    near = deck.contacts.tolerance * float(model.blocks.sizes.min())
    for ground in model.grounds:
        along = abs(float(ground.normal @ mirror.normal)) > 1.0 - ACROSS
        if along and abs(float((ground.point - mirror.point) @ mirror.normal)) <= near:
            yield Finding("symmetry-broken", f"{ground.label} lies in it: what is mirrored is not held there", *path)
    guided = model.guides.blocks[mirror.halves[model.guides.blocks]]
    if len(guided):
        them = named(guided, model.blocks.name)
        message = f"{them} cannot be guided and halved: by symmetry it moves in the plane only"
        yield Finding("symmetry-broken", message, *path, "halves")
    for number, section in enumerate(deck.content.ties):
        if section.ring is not None:
            words = "goes round the whole structure: give that, or the half of it with `through`, from ground to ground"
            yield Finding("symmetry-broken", f"{words} in the plane", "ties", number, "ring")
    sought = [case.deck_name for case in model.load_cases if case.question.record(Objective) is not None]
    for name in dict.fromkeys(sought):
        message = "a force through a cut of one half is no question of the other: give the whole structure"
        yield Finding("symmetry-broken", message, "load_cases", name, "objective")
    for case in model.load_cases:
        yield from _case_across(case, model, mirror)
        if case.time_history is not None:
            yield from _motion_across(case.deck_name, case.time_history, model, mirror)


def _motion_across(name: str, history: TimeHistory, model: Model, mirror: ModelMirror) -> Iterator[Finding]:
    """Motion of the base, and forces over time on blocks that the plane cuts, across it."""
    path: KeyPath = ("load_cases", name, "time_history")
    if any(abs(float(motion.direction @ mirror.normal)) > ACROSS for motion in history.motions):
        words = f"moves the base across {mirror.label}, and the halves are no images then: give the whole structure"
        yield Finding("symmetry-broken", words, *path, "motion")
    for number, force in enumerate(history.forces):
        loaded = np.abs(force.wrenches[:, :3] @ mirror.normal) > ACROSS
        if (cut := np.flatnonzero(loaded & mirror.halves)).size:
            words = (
                f"acts across {mirror.label} on {named(cut, model.blocks.name)}, which is cut by it: nothing is left"
            )
            yield Finding("symmetry-broken", words, *path, "forces", number, "direction")


def _case_across(case: LoadCase, model: Model, mirror: ModelMirror) -> Iterator[Finding]:
    """Loads and settlements across the plane of blocks that it cuts."""
    question, halved = case.question, mirror.halves[case.question.giving_way]
    across = np.zeros_like(mirror.halves)
    for load in (case.dead_load, case.live_load):
        across |= np.abs(load[:, :3] @ mirror.normal) > ACROSS * np.abs(load[:, :3]).max(initial=0.0)
    if (cut := np.flatnonzero(across & mirror.halves)).size and question.multiplies:
        message = (
            f"a load acts across {mirror.label} on {named(cut, model.blocks.name)}, which is cut by it: the other "
            "half is loaded the other way, and nothing is left of it"
        )
        yield Finding("symmetry-broken", message, "load_cases", case.name)
    if halved.any():
        moved = question.ways[halved]
        if question.kind == "moment" or np.any(np.abs(moved[:, :3] @ mirror.normal) > ACROSS):
            message = "a support that the plane of symmetry cuts can only give way along that plane, without turning"
            yield Finding("symmetry-broken", message, "load_cases", case.name, "settlement")
