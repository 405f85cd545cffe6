"""Two results side by side: deck texts and load cases; ``mbla diff --json`` prints its fields."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import unified_diff
from typing import Any

from mbla.deck.units import METRES
from mbla.results.diff.cases import CaseComparison, compare_cases
from mbla.results.diff.matching import match_blocks
from mbla.results.record.json_values import as_json
from mbla.results.record.scene import scene_of
from mbla.results.results import Results


@dataclass(frozen=True)
class ResultComparison:
    """What differs between results A and B; pairs are of A and of B.

    decks     : names
    deck_diff : lines of a unified diff of the deck texts
    overrides : changes by the user
    only      : names of load cases of A alone and of B alone
    """

    decks: tuple[str, str]
    created: tuple[str, str]
    deck_diff: tuple[str, ...]
    overrides: tuple[tuple[str, ...], tuple[str, ...]]
    cases: tuple[CaseComparison, ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]

    @property
    def differing(self) -> int:
        """Load cases whose status or answer differs, or that are in one result only."""
        return sum(case.differs for case in self.cases) + len(self.only[0]) + len(self.only[1])


def comparison_json(comparison: ResultComparison, files: tuple[str, str]) -> dict[str, Any]:
    """Everything that was compared; ``files`` are the names of A and B."""
    record: dict[str, Any] = {"files": list(files), "differing": comparison.differing} | as_json(comparison)
    for case, compared in zip(record["cases"], comparison.cases, strict=True):
        case["differs"] = compared.differs
    return record


def compare_results(first: Results, second: Results, tolerance: float | None = None) -> ResultComparison:
    """Everything that differs.

    tolerance : relative, of answers; None for the sum of what the two results are good to, at least 1e-6
    """
    length = METRES[second.model.units.length] / METRES[first.model.units.length]
    matching = match_blocks(first.model.blocks, second.model.blocks, length)
    own, others = ({case.load_case.name: case for case in results.cases} for results in (first, second))
    pairs = [(scene_of(first, own[name]), scene_of(second, others[name])) for name in own if name in others]
    return ResultComparison(
        decks=(first.deck.name, second.deck.name),
        created=(first.created, second.created),
        deck_diff=tuple(_deck_lines(first, second)),
        overrides=(first.deck.overrides, second.deck.overrides),
        cases=tuple(compare_cases(*pair, matching, tolerance) for pair in pairs),
        only=(tuple(name for name in own if name not in others), tuple(name for name in others if name not in own)),
    )


def _deck_lines(first: Results, second: Results) -> list[str]:
    """Unified diff of the deck texts, the decks themselves first, then what they include by its name."""
    (main, *own), (other, *its) = first.deck.sources, second.deck.sources
    a, b = dict(own), dict(its)
    texts = [(*main, *other), *((name, a.get(name, ""), name, b.get(name, "")) for name in a | b)]
    return [
        line
        for name, text, new_name, new_text in texts
        for line in unified_diff(
            text.splitlines(), new_text.splitlines(), f"A {name}", f"B {new_name}", n=1, lineterm=""
        )
    ]
