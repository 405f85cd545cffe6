"""What each reduction left out of a load case, as objects of the JSON record."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mbla.program.reductions.steps import ReductionStep
from mbla.results.records.key import Key


def reductions_json(steps: Sequence[ReductionStep]) -> list[dict[str, Any]]:
    """An object for each reduction, in the order in which they are applied."""
    return [_step(step) for step in steps]


def _step(step: ReductionStep) -> dict[str, Any]:
    sizes = {"before": dict(vars(step.before)), "after": dict(vars(step.after))}
    return {"name": step.name, "state": step.state.value, "found": step.found, **sizes}


def reduction_keys(place: str) -> tuple[Key, ...]:
    """Description of these objects in the list at ``place``."""
    size = ("unknowns", "cones", "entries", "largest")
    words = (
        "velocities",
        "friction cones, one a contact point; in a plane each is a pair of half-lines",
        "of the equilibrium matrices, other than zero",
        "unknowns of the largest program",
    )
    return (
        Key(place, "list", "what each reduction left out, in the order in which they are applied"),
        Key(f"{place}[]", "object", "a reduction"),
        Key(f"{place}[].name", "string", "planar, mirror, parts, unloaded, points, or glued"),
        Key(f"{place}[].state", "string", "applied, nothing found, switched off, would change the answer"),
        Key(
            f"{place}[].found",
            "integer",
            "contact points or blocks left out, or parts taken apart, reduced or left out",
        ),
        *(
            key
            for when in ("before", "after")
            for key in (
                Key(f"{place}[].{when}", "object", f"programs with live load {when} it"),
                *(Key(f"{place}[].{when}.{name}", "integer", text) for name, text in zip(size, words, strict=True)),
            )
        ),
    )
