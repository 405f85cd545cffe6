"""Decks whose blocks are the rigid parts of a mechanism: ``mbla export --macro-blocks``.

The deck of a result, with one of its load cases, in which the blocks of each part of the mechanism are glued to one
rigid body, and those at rest to each other and to the ground. Parts are groups, ``part_1`` and so on by their numbers
in the result, and ``at_rest``; blocks that the deck guides, and a settling support, stay bodies of their own.

With associative flow the load factor is the same: the mechanism is still possible, so that the kinematic bound holds,
and forces inside of a rigid body have to satisfy nothing, so that the static bound can only rise. A mechanism without
normality proves no bound: its state is one of the macro-blocks too, but perhaps not the one that is found, and the
associative factor can be greater.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.parameter_keys import path_of_key
from mbla.deck.references import groups
from mbla.deck.sections.materials import GLUED
from mbla.deck.sections.selectors import GROUND
from mbla.errors import KeyPath, UsageError
from mbla.results.collapse.rigid_parts import part_motions, parts_of_one_twist
from mbla.results.files import OutputFolder
from mbla.results.listing.sections.mechanism_words import motion_words
from mbla.results.movable_deck import movable_deck, sections_text
from mbla.results.outcome import answer_of, associative_of, result_of
from mbla.results.provenance import deck_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases, detailed_cases
from mbla.solution.solution import Mechanics

AT_REST = "at_rest"
APART = -1
"""number of the part of blocks that stay bodies of their own"""
WHOLE_DECK = ("find", "strengthen")
"""sections that ask for something of the whole deck, with all of its load cases"""
EXPECTED_WITHIN = 1e-6
"""relative difference of load factors that a written deck allows, or what the proved bounds leave open"""


def write_macro_blocks(
    results: Results,
    folder: Path,
    stem: str,
    cases: Sequence[str] = (),
    associative: bool = False,
    *,
    force: bool = False,
) -> list[Path]:
    """Write ``STEM_CASE_macro.yaml`` for each load case with a mechanism, and the files that it names; their paths.

    cases       : only these; of a travelling load it is the worst position that counts. Those of an objective have no
                  collapse
    associative : by the mechanism of associative flow, whatever the flow rule of the deck

    Raises
    ------
    UsageError
        no such load case, none with a mechanism, or a deck whose joints cannot be glued
    DeckError, FileError
        the deck in the result cannot be read, or a file is there already and ``force`` is not set
    """
    detailed = {case.load_case.name for case in detailed_cases(results.cases) if case.load_case.question.collapses}
    found = {}
    for case in chosen_cases(results, cases or None):
        mechanics = associative_of(case) if associative else result_of(case)
        if case.load_case.name in detailed and mechanics is not None:
            found[case.load_case.name] = case, mechanics
    if not found:
        raise UsageError("no-mechanism", "--macro-blocks: there is no mechanism in the load cases asked for")
    with TemporaryDirectory() as source:
        deck = deck_of(results.deck, Path(source), expected=False)
    movable = movable_deck(deck, results.deck.files, f"{stem}_macro")
    if (table := movable.data["contacts"].get("table")) is not None:
        refuse_joints_of_table(movable.files[table])
    with OutputFolder(folder, stem, force, secondary=True) as out:
        for name, content in movable.files.items():
            out.write_bytes(name, content)
        for name, (case, mechanics) in found.items():
            out.write_text(f"{stem}_{name}_macro.yaml", macro_deck(results, case, mechanics, movable.data, stem))
    return [folder / name for name in out.names]


def refuse_joints_of_table(content: bytes) -> None:
    """Raises UsageError where a table of interfaces has a column of joint laws."""
    lines = (line for line in content.decode(errors="replace").splitlines() if line and not line.startswith("#"))
    if "joint" in re.split(r"\s*[,;]\s*", next(lines, "").strip()):
        words = "--macro-blocks: the column joint of contacts.table holds before any glue: give the joints by overrides"
        raise UsageError("macro-blocks-not-possible", words)


def macro_deck(results: Results, case: CaseResult, mechanics: Mechanics, data: dict[str, Any], stem: str) -> str:
    """The text of the deck of one load case.

    data : the deck as read, without inclusions
    """
    load_case = case.load_case
    model = results.model.of_case(load_case)
    parts = parts_of_one_twist(model, results.assembly.glued(load_case), mechanics.mechanism)
    motions = part_motions(model, parts, mechanics.mechanism)
    parts[model.guides.blocks] = APART
    names = {part: f"part_{part}" if part else AT_REST for part in np.unique(parts[parts != APART]).tolist()}
    if not set(groups(data)).isdisjoint(names.values()):
        names = {part: f"macro_{name}" for part, name in names.items()}
    glue = [
        {"joint": GLUED, "between": [names[part], names[part] if part else [names[part], GROUND]]}
        for part in _with_joints(results, parts)
    ]
    contacts = data["contacts"]
    changed = {
        "title": f"Macro-blocks of {load_case.deck_name}, {results.deck.name}",
        "groups": {name: _selector(results, np.flatnonzero(parts == part)) for part, name in names.items()},
        "contacts": contacts | {"overrides": [*contacts.get("overrides", []), *glue]},
        "load_cases": {load_case.deck_name: _first_movement(data["load_cases"][load_case.deck_name])},
        "expected": _expected(case, mechanics, f"{stem}.h5"),
    }
    content = data | changed
    if "analysis" in data:
        content["analysis"] = with_slopes_left(data, content)
    text = sections_text(content, WHOLE_DECK)
    lines = [f"The rigid parts of a mechanism as blocks: load case {load_case.name} of {stem}.h5."]
    lines += [
        f"{names[each.number]}: {len(each.blocks)} blocks, {motion_words(model, each)}"
        for each in motions
        if each.number in names and len(each.blocks) > 1
    ]
    return "".join(f"# {line}\n" for line in lines) + text


def with_slopes_left(data: dict[str, Any], content: dict[str, Any]) -> dict[str, Any]:
    """Section analysis without sensitivity to what the written deck has no more, such as loads of other load cases."""
    analysis = dict(data["analysis"])
    if isinstance(keys := analysis.get("sensitivity"), list):
        analysis["sensitivity"] = [key for key in keys if _is_same(data, content, path_of_key(data, key))]
        if not analysis["sensitivity"]:
            del analysis["sensitivity"]
    return analysis


def _is_same(data: Any, content: Any, path: KeyPath) -> bool:
    """Whether two decks have the same at a path, or both leave it to its default in the same section."""
    for key in path:
        there = [key in each if isinstance(each, dict) else key in range(len(each)) for each in (data, content)]
        if not all(there):
            return not any(there)
        data, content = data[key], content[key]
    return bool(data == content)


def _first_movement(case: dict[str, Any]) -> dict[str, Any]:
    """The load case without what follows limit analysis: the parts of the first movement are not those of the next."""
    kept = {key: value for key, value in case.items() if key not in ("pushover", "assessment")}
    if "settlement" in kept:
        only_first = ("amount", "step", "error")
        several = isinstance(kept["settlement"], list)
        left_out = ("step", "error") if several else only_first  # amounts of several are their proportion
        supports = kept["settlement"] if several else [kept["settlement"]]
        first = [{key: value for key, value in each.items() if key not in left_out} for each in supports]
        kept["settlement"] = first if several else first[0]
    return kept


def _with_joints(results: Results, parts: IntArray) -> list[int]:
    """Parts within which there are joints, from that of each block, (n_blocks,); the ground belongs to what rests."""
    of_body = np.append(parts, np.zeros(len(results.model.grounds), dtype=np.int64))
    first, second = of_body[results.contacts.bodies].T
    joined: list[int] = np.unique(first[(first == second) & (first != APART)]).tolist()
    return joined


def _selector(results: Results, chosen: IntArray) -> list[Any]:
    """Blocks, (n,), by their names; a group by its name where all of it is chosen."""
    blocks = results.model.blocks
    sizes, rows = Counter(blocks.groups), defaultdict(list)
    for block in chosen.tolist():
        rows[blocks.groups[block]].append(int(blocks.group_indices[block]))
    terms: list[Any] = []
    for group, indices in rows.items():
        whole = len(indices) == sizes[group]
        terms += [group] if whole else [{"group": group, "index": index} for index in indices]
    return terms


def _expected(case: CaseResult, mechanics: Mechanics, name: str) -> dict[str, Any] | None:
    """What the macro-blocks should give, for ``mbla run --expected``; None where nothing proves that."""
    load_case, figures = case.load_case, dict[str, float]()
    group = load_case.question.group
    if group != "load_factor":
        figures = {group: answer_of(case)} if case.solution.flow_rule == "associative" else {}
    elif mechanics is case.solution.associative:
        figures = {"associative_load_factor": mechanics.load_factor}
    within = max(EXPECTED_WITHIN, case.checks.gap)
    source = {"tolerance": float(within), "source": f"the mechanism of {load_case.name} in {name}"}
    return {load_case.deck_name: figures | source} if figures else None
