"""Whether two settings solve the same model, so that the difference of their answers is an error, or two models.

The same: whatever in the analysis section says how the program is solved, friction polyhedra among it, which stand for
the cone. Another model: another flow rule or contact model, and anything outside of the analysis section, as the number
of contact points, friction or size.
"""

from __future__ import annotations

from mbla.deck.content import DeckContent

MODEL_KEYS = ("flow_rule", "contact_model")
"""keys of the analysis section that choose what is modelled"""
NO_MODEL = {"analysis", "output", "expected", "title"}


def other_model(deck: DeckContent, changed: DeckContent) -> str:
    """What makes it another model, as ``flow_rule, contacts``; empty where it is the same."""
    keys = [key for key in MODEL_KEYS if getattr(deck.analysis, key) != getattr(changed.analysis, key)]
    own, its = (content.model_dump(mode="json", exclude=NO_MODEL) for content in (deck, changed))
    return ", ".join([*keys, *(key for key in own if own[key] != its.get(key))])
