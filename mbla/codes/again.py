"""A result that exists, assessed anew: for another earthquake, another code, or for the first time."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from mbla.codes.assess import assessed
from mbla.deck.content import DeckContent
from mbla.errors import UsageError
from mbla.results.provenance import deck_of, with_loads_found
from mbla.results.results import Results


def assessed_again(results: Results, overrides: Sequence[str] = ()) -> Results:
    """Results with assessments by the deck in them, changed by ``key.path=value`` texts; nothing is solved.

    Raises
    ------
    DeckError
        the deck is not valid so
    UsageError
        more is changed than assessments and parameters of them, or no load case has one
    """
    record = replace(results.deck, overrides=(*results.deck.overrides, *overrides))
    with tempfile.TemporaryDirectory() as before, tempfile.TemporaryDirectory() as after:
        deck = deck_of(record, Path(after), expected=False)
        if _solved_for(deck.content) != _solved_for(deck_of(results.deck, Path(before), expected=False).content):
            words = "changes more than assessments of load cases, for which the deck has to be run"
            raise UsageError("changes-the-analysis", f"--set {' --set '.join(overrides)}: {words}")
    asked = {name: section.assessment for name, section in deck.content.load_cases.items()}
    if not any(asked[case.load_case.deck_name] for case in results.cases):
        words = (
            "no load case with a result has an assessment; --set load_cases.NAME.assessment.spectra=... gives it one"
        )
        raise UsageError("no-assessment", f"{results.deck.name}: {words}")
    cases = [
        replace(case, load_case=replace(case.load_case, assessment=asked[case.load_case.deck_name]))
        for case in results.cases
    ]
    cases = [assessed(results.assembly, case) for case in cases]
    return replace(
        results,
        deck=replace(record, sha256=deck.sha256),
        assembly=with_loads_found(results.assembly, cases),
        cases=tuple(cases),
    )


def _solved_for(content: DeckContent) -> dict[str, Any]:
    """All of a deck that forces and mechanisms follow from, evaluated."""
    return content.model_dump(exclude={"parameters": True, "load_cases": {"__all__": {"assessment"}}})
