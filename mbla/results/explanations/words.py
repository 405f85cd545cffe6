"""Explanations as text and as records."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mbla.results.explanations.explanation import Explanation
from mbla.results.explanations.explanations import SECTIONS
from mbla.results.listing.text import WIDTH, heading, sentence


def explanation_text(found: Sequence[Explanation]) -> str:
    """One entry in full; of several, each in a line."""
    lines = _in_full(found[0]) if len(found) == 1 else _in_lines(found)
    return "\n".join(lines) + "\n"


def all_text() -> str:
    """Every entry in a line, by sections."""
    lines = []
    for title, entries in SECTIONS.items():
        lines += [*heading(title), *_in_lines(entries)]
    lines += ["", "mbla explain ID explains one in full; a word or a whole message finds it too."]
    return "\n".join(lines[1:]) + "\n"


def explanation_json(entry: Explanation) -> dict[str, Any]:
    """An entry with its keys."""
    return {
        "identifier": entry.identifier,
        "kind": entry.kind,
        "title": entry.title,
        "meaning": entry.meaning,
        "cause": entry.cause,
        "remedy": entry.remedy,
        "example": entry.example or None,
        "aliases": list(entry.aliases),
    }


def _in_full(entry: Explanation) -> list[str]:
    lines = [f"{entry.identifier}   ({entry.kind})", *sentence(entry.title)]
    parts = (
        ("For the load factor", entry.meaning),
        ("What brings it about", entry.cause),
        ("What to do", entry.remedy),
        ("Example", entry.example),
    )
    for title, text in parts:
        if text:
            lines += ["", f"{title}:", *sentence(text)]
    return lines


def _in_lines(entries: Sequence[Explanation]) -> list[str]:
    column = 2 + max(len(entry.identifier) for entry in entries)
    return [f"  {entry.identifier:<{column}}{shortened_title(entry, WIDTH - column - 2)}" for entry in entries]


def shortened_title(entry: Explanation, width: int) -> str:
    """The title in one line; its end left out where it is longer."""
    return entry.title if len(entry.title) <= width else f"{entry.title[: width - 2].rstrip()}.."
