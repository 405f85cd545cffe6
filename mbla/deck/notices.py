"""What a valid deck should make its author look twice at.

Keys without effect are no faults: ``--flow-rule`` and ``--set`` leave keys unused that the deck has for another run.
"""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck.content import DeckContent, soils_of
from mbla.deck.expressions import Parameters
from mbla.deck.references import unused_names
from mbla.deck.sections.analysis import APPLIES
from mbla.deck.text.tree import Tree, key_text
from mbla.deck.units import Units
from mbla.deck.unusual import unusual_gravity, unusual_values
from mbla.errors import KeyPath, Message, Notice


def notices_of(tree: Tree, content: DeckContent, units: Units, parameters: Parameters) -> tuple[Notice, ...]:
    """Warnings about unusual values and keys without effect, and remarks on names that nothing uses."""
    odd = (*unusual_gravity(tree, content, units), *unusual_values(tree, content, units))
    return (*odd, *unused_keys(tree, content), *_unused(tree, content, parameters))


def _unused(tree: Tree, content: DeckContent, parameters: Parameters) -> Iterator[Notice]:
    unused = [("parameters", name) for name in content.parameters if name not in parameters.used]
    for section, name in (*unused, *unused_names(tree.data)):
        identifier = f"{section.removesuffix('s')}-unused"
        path = (section, name)
        if section == "vehicles" and tree.source_of(tree.value_mark(path)) is not tree.sources[0]:
            continue  # one of a library
        yield Notice("notice", identifier, f"{tree.place_at(path)} {key_text(path)} is not used")


def unused_keys(tree: Tree, content: DeckContent) -> Iterator[Notice]:
    """A warning for each key that is given without effect."""
    analysis = content.analysis
    given = tree.data.get("analysis") or {}
    for key, (applies, where) in APPLIES.items():
        if key in given and not applies(analysis):
            yield _notice(tree, ("analysis", key), where)
    if analysis.soil_range and not any(soils_of(content)):
        yield _notice(tree, ("analysis", "soil_range"), "soil of cells")
    in_time = any(case.time_history or case.modes for case in content.load_cases.values())
    for name, joint in content.joints.items():
        if joint.dilatancy > 0.0 and analysis.flow_rule != "dilatancy":
            yield _notice(tree, ("joints", name, "dilatancy"), "flow_rule: dilatancy")
        if joint.stiffness is not None and not in_time:
            yield _notice(tree, ("joints", name, "stiffness"), "load cases with time_history or modes")
    for path, soil in soils_of(content):
        if soil.dilatancy > 0.0 and analysis.flow_rule != "dilatancy":
            yield _notice(tree, (*path, "dilatancy"), "flow_rule: dilatancy")


def _notice(tree: Tree, path: KeyPath, where: str) -> Notice:
    fault = tree.fault(path, Message("key-idle", f"has no effect: it applies to {where}"))
    return Notice("warning", "key-idle", str(fault))
