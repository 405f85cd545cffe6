"""What ``mbla explain`` prints: the entries of ``messages.toml``, found by identifier, other name, message or word."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib import import_module
from importlib.resources import files
from string import Template
from textwrap import wrap
from typing import Any

from mbla.deck.suggestions import did_you_mean
from mbla.errors import UsageError
from mbla.results.listing.text import WIDTH, heading, sentence

TOLD = "The message itself says what is wrong, where, and what to do."
"""title of an entry that has nothing to add to its message"""


@dataclass(frozen=True)
class Explanation:
    """One entry; one whose message says all has the title ``TOLD``, and neither cause nor remedy.

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
    figures = {name: f"{_constant(path):g}" for name, path in content.pop("figures").items()}
    words = figures | {name: _filled(text, figures) for name, text in content.pop("shared").items()}
    found = {}
    for section in content.values():
        common = {key: value for key, value in section.items() if key != "title" and not isinstance(value, dict)}
        says_all = common.pop("message_says_all", ())
        told = dict.fromkeys(says_all, common | {"title": TOLD, "cause": "", "remedy": ""})
        entries = {name: {**common, **entry} for name, entry in section.items() if isinstance(entry, dict)}
        found[section["title"]] = tuple(_explanation(name, entry, words) for name, entry in (entries | told).items())
    return found


def _constant(path: str) -> float:
    """A constant of the program, ``mbla.solution.thresholds.GAP_TOLERANCE``."""
    module, _, name = path.rpartition(".")
    return float(getattr(import_module(module), name))


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


def find_explanations(query: str) -> tuple[Explanation, ...]:
    """Entries for an identifier, another name of one, a complete message, or a word; the exact one alone.

    Raises UsageError where nothing fits.
    """
    name = _kebab(query)
    entries = explanations().values()
    exact = [entry for entry in entries if name in (entry.identifier, *map(_kebab, entry.aliases))]
    if exact:
        return tuple(exact)
    found = _of_message(query) or _with_word(query)
    if not found:
        names = [*explanations(), *(alias for entry in entries for alias in entry.aliases)]
        near = did_you_mean(name, names[:200]) or did_you_mean(name, names[200:])
        raise UsageError(
            "explain-unknown",
            f"explain {query}: nothing is known by that name{near or '; mbla explain lists every identifier'}",
        )
    return found


def _kebab(text: str) -> str:
    return "-".join(text.strip().strip("[]").casefold().replace("_", " ").replace("-", " ").split())


def _of_message(query: str) -> tuple[Explanation, ...]:
    """What a complete message is about: by the identifier in brackets, else by what it says."""
    entries = explanations().values()
    bracketed = [entry for entry in entries if f"[{entry.identifier}]" in query]
    return tuple(bracketed or [entry for entry in entries if any(words in query for words in entry.says)])


def _with_word(query: str) -> tuple[Explanation, ...]:
    """Entries that have all words of the query in identifier, title or messages; else anywhere."""
    words = _kebab(query).split("-")

    def having(texts: Sequence[str]) -> bool:
        text = " ".join(texts).casefold().replace("-", " ").replace("_", " ")
        return any(words) and all(word in text for word in words)

    entries = explanations().values()
    near = tuple(
        entry
        for entry in entries
        if having([entry.identifier, entry.title.removeprefix(TOLD), *entry.aliases, *entry.says])
    )
    return near or tuple(entry for entry in entries if having([entry.meaning, entry.cause, entry.remedy]))


# --- as text and as records -----------------------------------------------------------------------------------------


def explanation_text(found: Sequence[Explanation]) -> str:
    """One entry in full; of several, each in a line."""
    lines = _in_full(found[0]) if len(found) == 1 else _in_lines(found)
    return "\n".join(lines) + "\n"


def all_text() -> str:
    """Every entry in a line, by sections; those that have nothing to add to their message in sentences."""
    lines: list[str] = []
    for title, entries in sections().items():
        lines += [*heading(title), *_in_lines([entry for entry in entries if entry.title != TOLD])]
        told = [entry.identifier for entry in entries if entry.title == TOLD]
        lines += ["", "  The message itself says all:", *_in_names(told)] if told else []
    lines += ["", "mbla explain ID explains one in full; a word or a complete message finds it too."]
    return "\n".join(lines[1:]) + "\n"


def explanation_json(entry: Explanation) -> dict[str, Any]:
    """An entry with its keys."""
    record = asdict(entry)
    del record["says"]
    texts = {key: record[key] or None for key in ("cause", "remedy", "example")}
    return {**record, **texts, "aliases": list(entry.aliases)}


def _in_full(entry: Explanation) -> list[str]:
    lines = [f"{entry.identifier}   ({entry.kind})", *sentence(entry.title)]
    parts = (
        ("What it means", entry.meaning),
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


def _in_names(identifiers: Sequence[str]) -> list[str]:
    indent = "    "
    return wrap(", ".join(identifiers), WIDTH, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)


def _shortened(title: str, width: int) -> str:
    """One line; the end left out where it is longer."""
    return title if len(title) <= width else f"{title[: width - 2].rstrip()}.."
