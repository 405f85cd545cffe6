"""What a message says on a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from mbla.deck.text.tree import shorten

_MOST_NAMES = 20
_MOST_COMPARED = 200


def unknown(kind: str, word: str, allowed: Iterable[str], label: str = "allowed") -> str:
    """``unknown material; did you mean stone? known: stone or brick``."""
    names = list(allowed)
    return f"unknown {kind}{did_you_mean(word, names) or ';'} {label}: {listed(names, 'and')}"


def did_you_mean(word: str, allowed: Iterable[str]) -> str:
    """``; did you mean friction?``, or nothing."""
    names = list(allowed)
    if len(names) > _MOST_COMPARED:  # comparing is slow: of many names, those that begin alike
        names = [name for name in names if name[:2].casefold() == word[:2].casefold()][:_MOST_COMPARED]
    by_case = {name.casefold().replace("-", "_"): name for name in names}
    close = get_close_matches(word.casefold().replace("-", "_")[:80], by_case, n=1, cutoff=0.6)
    return f"; did you mean {shorten(by_case[close[0]])}?" if close else ""


def listed(names: Iterable[str], last: str = "or") -> str:
    """``a, b or c``; only the first of many names."""
    all_names = list(names)
    shown = [shorten(name) for name in all_names[:_MOST_NAMES]]
    if len(all_names) > len(shown):
        return ", ".join(shown) + f" and {len(all_names) - len(shown)} more"
    return f" {last} ".join(filter(None, (", ".join(shown[:-1]), shown[-1]))) if shown else "none"
