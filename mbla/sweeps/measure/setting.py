"""One setting of a deck: values put into it, and knobs left to what ``analysis.accuracy`` makes of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mbla.deck import Deck, read_deck
from mbla.deck.sections.analysis import AnalysisSection

LIMITS = ("max_iterations", "time_limit")
"""knobs without a default that are limits of effort, none of accuracy"""


@dataclass(frozen=True)
class Setting:
    """A deck as it is run once.

    overrides : ``key.path=value`` texts, after those of the command line
    freed     : knobs of the analysis section that the deck gives and this setting leaves to ``accuracy``
    """

    overrides: tuple[str, ...] = ()
    freed: tuple[str, ...] = ()


def read_setting(path: Path, fixed: Sequence[str], setting: Setting) -> Deck:
    """The deck under a setting; ``fixed`` holds for every setting. Raises DeckError and FileError as ``read_deck``."""
    deck = read_deck(path, (*fixed, *setting.overrides))
    if not setting.freed:
        return deck
    free = {name: AnalysisSection.model_fields[name].default for name in setting.freed}
    analysis = deck.analysis.model_copy(update=free)
    return replace(deck, content=deck.content.model_copy(update={"analysis": analysis}))


def given_knobs(deck: Deck, fixed: Sequence[str]) -> tuple[str, ...]:
    """Knobs that ``accuracy`` sets and the deck gives by itself; not those of ``fixed``, which the user wants so."""
    chosen = {text.partition("=")[0].strip().removeprefix("analysis.") for text in fixed}
    return tuple(
        name
        for name, field in AnalysisSection.model_fields.items()
        if field.default is None and name not in LIMITS and name not in chosen
        if getattr(deck.analysis, name) is not None
    )
