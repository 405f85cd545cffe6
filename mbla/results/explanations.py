"""What ``mbla explain`` tells: the entries of ``messages.toml``, found by identifier, other name, message or word."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib.resources import files
from string import Template
from typing import Any

from mbla.deck.notices import GRAVITY_TOLERANCE
from mbla.deck.suggestions import did_you_mean
from mbla.deck.units import STANDARD_GRAVITY
from mbla.errors import UsageError
from mbla.model.build import UNLIMITED
from mbla.model.solids.build import PLANAR
from mbla.results.collapse.interface_modes import TOGETHER
from mbla.results.listing.text import WIDTH, heading, sentence
from mbla.results.outcome import CLEAN_RESIDUAL, UNIQUE
from mbla.solution.part import SUSPECT
from mbla.solution.thresholds import (
    APPROXIMATE_RESIDUAL,
    EXACT_RESIDUAL,
    GAP_TOLERANCE,
    LIVE_POWER_DEVIATION,
    SOLVED_EQUILIBRIUM,
    SOLVED_RESIDUAL,
)
from mbla.solution.verification.further_claims import LASTING, SAME_LOADS, UNBALANCED

FIGURES = {
    "gravity_tolerance": f"{GRAVITY_TOLERANCE:.0%}",
    "standard_gravity": f"{STANDARD_GRAVITY:g}",
    "planar": f"{PLANAR:g}",
    "unlimited_friction": f"{UNLIMITED:g}",
    "still": f"{TOGETHER:g}",
    "clean_residual": f"{CLEAN_RESIDUAL:g}",
    "unique": f"{UNIQUE:g}",
    "peak_suspected_below": f"{SUSPECT:g}",
    "approximate_residual": f"{APPROXIMATE_RESIDUAL:g}",
    "gap_tolerance": f"{GAP_TOLERANCE:g}",
    "live_power": f"{LIVE_POWER_DEVIATION:g}",
    "solved_equilibrium": f"{SOLVED_EQUILIBRIUM:g}",
    "solved_residual": f"{SOLVED_RESIDUAL:g}",
    "unbalanced_live_load": f"{LASTING:g}",
    "peak_residual": f"{EXACT_RESIDUAL:g}",
    "range_residual": f"{EXACT_RESIDUAL:g}",
    "unbalanced_dead_load": f"{UNBALANCED:g}",
    "same_tilt_loads": f"{SAME_LOADS:g}",
}
"""Thresholds that the explanations name, as they are printed."""


@dataclass(frozen=True)
class Explanation:
    """One entry.

    identifier : stable, in kebab case; what stands in brackets in listings and under ``identifier`` in JSON
    kind       : what carries it: a notice, a status, an error, ...
    title      : one line
    meaning    : what it means for the load factor
    cause      : what brings it about
    remedy     : what to do
    example    : a message or a remedy as it looks; may be empty
    aliases    : other words by which the program prints it
    says       : parts of the messages by which a pasted message is recognised
    """

    identifier: str
    kind: str
    title: str
    meaning: str
    cause: str
    remedy: str
    example: str = ""
    aliases: tuple[str, ...] = ()
    says: tuple[str, ...] = ()


@cache
def sections() -> dict[str, tuple[Explanation, ...]]:
    """Every explanation under the title of its section."""
    content = tomllib.loads(files("mbla.results").joinpath("messages.toml").read_text(encoding="utf-8"))
    shared = {name: _filled(text, FIGURES) for name, text in content.pop("shared").items()}
    words = {**FIGURES, **shared}
    found = {}
    for section in content.values():
        common = {key: value for key, value in section.items() if key != "title" and not isinstance(value, dict)}
        entries = {name: {**common, **entry} for name, entry in section.items() if isinstance(entry, dict)}
        found[section["title"]] = tuple(_explanation(name, entry, words) for name, entry in entries.items())
    return found


@cache
def explanations() -> dict[str, Explanation]:
    """Every explanation by its identifier."""
    return {entry.identifier: entry for entries in sections().values() for entry in entries}


def _explanation(identifier: str, entry: dict[str, Any], words: dict[str, str]) -> Explanation:
    values: dict[str, Any] = {
        key: tuple(value) if isinstance(value, list) else _filled(value, words) for key, value in entry.items()
    }
    return Explanation(identifier=identifier, **values)


def _filled(text: str, words: dict[str, str]) -> str:
    return Template(" ".join(text.split())).substitute(words)


# --- finding --------------------------------------------------------------------------------------------------------


def find_explanations(asked: str) -> tuple[Explanation, ...]:
    """Entries for an identifier, another name of one, a message pasted whole, or a word; the exact one alone.

    Raises
    ------
    UsageError
        nothing fits
    """
    name = _kebab(asked)
    entries = explanations().values()
    exact = [entry for entry in entries if name in (entry.identifier, *map(_kebab, entry.aliases))]
    if exact:
        return tuple(exact)
    found = _of_message(asked) or _with_word(asked)
    if not found:
        names = [*explanations(), *(alias for entry in entries for alias in entry.aliases)]
        near = did_you_mean(name, names[:200]) or did_you_mean(name, names[200:])
        raise UsageError(
            "explain-unknown",
            f"explain {asked}: nothing is known by that name{near or '; mbla explain lists every identifier'}",
        )
    return found


def _kebab(text: str) -> str:
    return "-".join(text.strip().strip("[]").casefold().replace("_", " ").replace("-", " ").split())


def _of_message(asked: str) -> tuple[Explanation, ...]:
    """What a whole message is about: by the identifier in brackets, else by what it says."""
    entries = explanations().values()
    bracketed = [entry for entry in entries if f"[{entry.identifier}]" in asked]
    return tuple(bracketed or [entry for entry in entries if any(words in asked for words in entry.says)])


def _with_word(asked: str) -> tuple[Explanation, ...]:
    """Entries that have all words asked for in identifier, title or messages; else anywhere."""
    words = _kebab(asked).split("-")

    def having(texts: Sequence[str]) -> bool:
        text = " ".join(texts).casefold().replace("-", " ").replace("_", " ")
        return any(words) and all(word in text for word in words)

    entries = explanations().values()
    near = tuple(entry for entry in entries if having([entry.identifier, entry.title, *entry.aliases, *entry.says]))
    return near or tuple(entry for entry in entries if having([entry.meaning, entry.cause, entry.remedy]))


# --- as text and as records -----------------------------------------------------------------------------------------


def explanation_text(found: Sequence[Explanation]) -> str:
    """One entry in full; of several, each in a line."""
    lines = _in_full(found[0]) if len(found) == 1 else _in_lines(found)
    return "\n".join(lines) + "\n"


def all_text() -> str:
    """Every entry in a line, by sections."""
    lines = [line for title, entries in sections().items() for line in (*heading(title), *_in_lines(entries))]
    lines += ["", "mbla explain ID explains one in full; a word or a whole message finds it too."]
    return "\n".join(lines[1:]) + "\n"


def explanation_json(entry: Explanation) -> dict[str, Any]:
    """An entry with its keys."""
    record = asdict(entry)
    del record["says"]
    return {**record, "example": entry.example or None, "aliases": list(entry.aliases)}


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
    return [f"  {entry.identifier:<{column}}{_shortened(entry.title, WIDTH - column - 2)}" for entry in entries]


def _shortened(title: str, width: int) -> str:
    """One line; the end left out where it is longer."""
    return title if len(title) <= width else f"{title[: width - 2].rstrip()}.."
