"""The convex contact model, and solvers that a deck asks for, on a sample of the extremes.

None of these structures twists, so that the load factors of the convex model are those of the contact points.
"""

from __future__ import annotations

from collections.abc import Iterator

from mbla.solution.thresholds import GAP_TOLERANCE
from tests.extremes.decks import BLOCK, FACTORS, ruled
from tests.extremes.outcome import Scene
from tests.extremes.shapes import FAR_APART, SLENDER, STACKED
from tests.extremes.weights import PORTAL, SAID, TOWER, tower_factor

FAMILY = "convex contact model"

CONVEX = (ruled("associative"), "analysis.contact_model=convex")

ORDERS = {
    "heavy on light": (0, 0, 1),
    "light on heavy": (1, 0, 0),
    "light between heavy": (1, 0, 1),
    "heavy between light": (0, 1, 0),
    "each lighter than the one below": (2, 1, 0),
}


def convex_sizes() -> Iterator[Scene]:
    """A block, a wall and an arch of other lengths and densities."""
    for structure in ("block", "wall", "arch"):
        deck, expected, tolerance = FACTORS[structure, "associative"]
        for what, key in (("lengths", "s"), ("density", "rho")):
            for k in (-6, -3, 3, 6):
                overrides = (f"parameters.{key}=1.0e{k}", *CONVEX)
                name = f"{structure}, {what} 1e{k}"
                yield Scene(name, FAMILY, deck, overrides, expected, tolerance, long=structure != "block")


def convex_weights() -> Iterator[Scene]:
    """Neighbours 1e2 to 1e8 apart; where each is 1e8 lighter than the one below, the top is lost and told."""
    for name, exponents in ORDERS.items():
        for k in (2, 4, 6, 8):
            loads = tuple(10.0 ** (k * exponent) for exponent in exponents)
            values = [f"parameters.{key}={load:.1e}" for key, load in zip("abc", loads, strict=True)]
            expected, said = tower_factor((loads[0], loads[1], loads[2])), SAID if k * max(exponents) > 8 else ()
            yield Scene(f"tower, {name}, 1e{k} apart", FAMILY, TOWER, (*values, *CONVEX), expected, diagnosis=said)
    for k in (4, 8):
        for name, key in (("heavy lintel", "lintel"), ("heavy piers", "pier")):
            overrides = (f"parameters.{key}=1.0e{k}", *CONVEX)
            yield Scene(f"lintel on piers, {name}, 1e{k} apart", FAMILY, PORTAL, overrides, 0.3)


def convex_friction() -> Iterator[Scene]:
    """Sliding, and rocking, of a block half as wide as high."""
    deck, rocks, _ = FACTORS["block", "associative"]
    for mu in ("0.01", "1.0e-4", "1.0e-6", "10", "1.0e3", "1.0e6"):
        overrides = (f"parameters.mu={mu}", *CONVEX)
        yield Scene(f"block, friction {mu}", FAMILY, deck, overrides, min(float(mu), rocks))


def convex_slender() -> Iterator[Scene]:
    """min(mu, b/h) of a block, and of two on each other, that slide or rock."""
    for k in range(-4, 5):
        for deck, what in ((SLENDER, "block"), (STACKED, "two blocks")):
            overrides = (f"parameters.b=1.0e{k}", "parameters.mu=0.6", *CONVEX)
            yield Scene(f"{what}, width 1e{k} of the height", FAMILY, deck, overrides, min(0.6, 10.0**k))
    for k in range(-6, 5):
        overrides = (f"parameters.b=1.0e{k}", "parameters.mu=1.0e5", *CONVEX)
        said = (FAR_APART,) if k < -3 else ()
        tolerance = GAP_TOLERANCE if k == -3 else 1e-6  # solved, and its bounds 1.2e-6 apart
        name = f"block, width 1e{k} of the height, friction 1e5"
        yield Scene(name, FAMILY, SLENDER, overrides, 10.0**k, tolerance, said)


CHOICES = {
    "solver mbla": ("analysis.solver=mbla",),
    "solver clarabel": ("analysis.solver=clarabel",),
    "solver highs": ("analysis.solver=highs", "analysis.friction_cone=polyhedral"),
    "convex contact model": ("analysis.contact_model=convex",),
}


def forced() -> Iterator[Scene]:
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


SCENES = (*convex_sizes(), *convex_weights(), *convex_friction(), *convex_slender(), *forced())
