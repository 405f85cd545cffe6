"""Section `groups`: named selectors. Wherever a deck selects blocks, a name of this section stands for its selector.

The names are replaced in the deck as read, before it is checked: later stages know nothing of them, and what is wrong
with a choice is reported where it is written.
"""

from __future__ import annotations

from typing import Any

from mbla.deck.references import SELECTORS, find
from mbla.deck.text.tree import MappingMarks, Marks, SequenceMarks, Tree


def put_groups_in_place(tree: Tree) -> None:
    """Replace the names of section `groups` by their selectors in every place where blocks are chosen."""
    named, marks = tree.data.get("groups"), tree.marks.values.get("groups")
    if not isinstance(named, dict) or not isinstance(marks, MappingMarks):
        return
    known = {name: (selector, marks.values[name]) for name, selector in named.items()}
    for place in SELECTORS:
        for path, selector in find(tree.data, place.split(".")):
            data: Any = tree.data
            beside: Any = tree.marks.values
            for key in path[:-1]:
                data, below = data[key], beside[key]
                beside = below.values if isinstance(below, MappingMarks) else below.items
            data[path[-1]], beside[path[-1]] = _in_full(selector, beside[path[-1]], known)


def _in_full(selector: Any, marks: Marks, known: dict[str, tuple[Any, Marks]]) -> tuple[Any, Marks]:
    """A selector with its marks, without names of the section."""
    if isinstance(selector, str):
        return known.get(selector, (selector, marks))
    if not isinstance(selector, list) or not isinstance(marks, SequenceMarks):
        return selector, marks
    terms: list[Any] = []
    joined = SequenceMarks(marks.own)
    for term, mark in zip(selector, marks.items, strict=True):
        chosen, chosen_marks = _in_full(term, mark, known) if isinstance(term, str) else (term, mark)
        if isinstance(chosen, list) and isinstance(chosen_marks, SequenceMarks):  # a list of terms holds no lists
            terms += chosen
            joined.items += chosen_marks.items
        else:
            terms.append(chosen)
            joined.items.append(chosen_marks)
    return terms, joined
