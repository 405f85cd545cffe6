"""The registry of explanations, and how one is found by identifier, other name, message or word."""

from __future__ import annotations

from mbla.deck.suggestions import did_you_mean
from mbla.errors import UsageError
from mbla.results.explanations.explanation import Explanation
from mbla.results.explanations.of_commands import OF_COMMANDS
from mbla.results.explanations.of_contacts import OF_CONTACTS
from mbla.results.explanations.of_deck import OF_DECK
from mbla.results.explanations.of_errors import OF_ERRORS
from mbla.results.explanations.of_exit import OF_EXIT
from mbla.results.explanations.of_faults import OF_FAULTS
from mbla.results.explanations.of_model import OF_MODEL
from mbla.results.explanations.of_program import OF_PROGRAM
from mbla.results.explanations.of_solver import OF_SOLVER
from mbla.results.explanations.of_status import OF_MODES, OF_STANDING, OF_STATUS
from mbla.results.explanations.of_sweep import OF_SWEEP
from mbla.results.explanations.of_verification import OF_VERIFICATION

SECTIONS = {
    "Statuses of load cases": OF_STATUS,
    "Exit statuses": OF_EXIT,
    "Verification, residuals and bounds": OF_VERIFICATION,
    "Remarks of the solver": OF_SOLVER,
    "Standing under dead load": OF_STANDING,
    "Modes of joints": OF_MODES,
    "Contacts": OF_CONTACTS,
    "Contact model": OF_PROGRAM,
    "Blocks, files and loads": OF_MODEL,
    "Deck": OF_DECK,
    "Parameter sweeps": OF_SWEEP,
    "Errors": OF_ERRORS,
    "Faults of decks and sweep files": OF_FAULTS,
    "Errors of commands, files and solvers": OF_COMMANDS,
}
"""Every explanation under the title of its section."""

EXPLANATIONS = {entry.identifier: entry for entries in SECTIONS.values() for entry in entries}


def find_explanations(asked: str) -> tuple[Explanation, ...]:
    """Entries for an identifier, another name of one, a message pasted whole, or a word; the exact one alone.

    Raises
    ------
    UsageError
        nothing fits
    """
    name = _kebab(asked)
    exact = [
        entry
        for entry in EXPLANATIONS.values()
        if name == entry.identifier or name in (_kebab(alias) for alias in entry.aliases)
    ]
    if exact:
        return tuple(exact)
    found = _of_message(asked) or _with_word(asked)
    if not found:
        names = [*EXPLANATIONS, *(alias for entry in EXPLANATIONS.values() for alias in entry.aliases)]
        near = did_you_mean_of(name, names) or "; mbla explain lists every identifier"
        raise UsageError("explain-unknown", f"explain {asked}: nothing is known by that name{near}")
    return found


def did_you_mean_of(name: str, names: list[str]) -> str:
    """The nearest identifier wherever in the list it stands."""
    return did_you_mean(name, names[:200]) or did_you_mean(name, names[200:])


def _kebab(text: str) -> str:
    return "-".join(text.strip().strip("[]").casefold().replace("_", " ").replace("-", " ").split())


def _of_message(asked: str) -> tuple[Explanation, ...]:
    """What a whole message is about: by the identifier in brackets, else by what it says."""
    bracketed = [entry for entry in EXPLANATIONS.values() if f"[{entry.identifier}]" in asked]
    if bracketed:
        return tuple(bracketed)
    return tuple(entry for entry in EXPLANATIONS.values() if any(words in asked for words in entry.says))


def _with_word(asked: str) -> tuple[Explanation, ...]:
    """Entries that have all words asked for in identifier, title or messages; else anywhere."""
    words = asked.casefold().replace("-", " ").replace("_", " ").split()

    def having(texts: list[str]) -> bool:
        text = " ".join(texts).casefold().replace("-", " ").replace("_", " ")
        return bool(words) and all(word in text for word in words)

    entries = EXPLANATIONS.values()
    near = tuple(entry for entry in entries if having([entry.identifier, entry.title, *entry.aliases, *entry.says]))
    return near or tuple(entry for entry in entries if having([entry.meaning, entry.cause, entry.remedy]))
