"""Solvers, forms and contact models that a deck asks for, on a sample of the extremes."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import BLOCK, ruled
from tests.extremes.outcome import Scene
from tests.extremes.weights import SAID, TOWER, tower_factor

CHOICES = {
    "solver mbla": ("analysis.solver=mbla",),
    "solver clarabel": ("analysis.solver=clarabel",),
    "solver highs": ("analysis.solver=highs", "analysis.friction_cone=polyhedral"),
    "convex contact model": ("analysis.contact_model=convex",),
}


def scenes() -> Iterator[Scene]:
    """Weights 1e4 apart, lengths of 1e-6 and 1e6 m, friction of 1e-3 and 1e6: with associative flow."""
    rule = ruled("associative")
    for name, choice in CHOICES.items():
        for k in (4, 8):
            for order, weights in (("heavy on light", (1.0, 1.0, 10.0**k)), ("light on heavy", (10.0**k, 1.0, 1.0))):
                values = [f"parameters.{key}={weight:.1e}" for key, weight in zip("abc", weights, strict=True)]
                yield Scene(
                    f"tower, {order}, 1e{k} apart, {name}",
                    "forced solvers and models",
                    TOWER,
                    (*values, rule, *choice),
                    tower_factor(weights),
                    diagnosis=(*SAID, "approximate", "not_verified") if k > 4 else (),
                )
        for setting in ("s=1.0e-6", "s=1.0e6", "mu=1.0e-3", "mu=1.0e6"):
            factor = 1e-3 if setting == "mu=1.0e-3" else 0.5
            yield Scene(
                f"block, {setting}, {name}",
                "forced solvers and models",
                BLOCK,
                (f"parameters.{setting}", rule, *choice),
                factor,
            )


SCENES = tuple(scenes())
