"""What the rules of several sections share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from mbla.deck.section import Finding
from mbla.deck.suggestions import listed
from mbla.errors import Message

ROUNDING = 1e-9
"""Relative: sums of lengths such as 6 x 0.175 are not exact in binary."""


def given(section: Any, keys: Sequence[str]) -> list[str]:
    """Those of the keys that a section has."""
    return [key for key in keys if getattr(section, key) is not None]


def exactly_one(section: Any, keys: Sequence[str], what: str = "", kind: str = "") -> Iterator[Finding]:
    """Findings where a section has none or several of some keys.

    what : ends the sentence
    kind : stands for the list of keys, where they are too many for one line
    """
    found = given(section, keys)
    if not found:
        some = (
            f"one {kind}, such as {listed(keys[:3])}: the key reference lists all" if kind else f"one of {listed(keys)}"
        )
        yield (), Message("missing-key", f"needs {some}{what}")
    elif len(found) > 1:
        one = f"one {kind}" if kind else f"one of {listed(keys)}"
        yield (found[1],), Message("one-of-several", f"only {one} may be given{what}, here are {listed(found, 'and')}")


def least_below_greatest(low: Sequence[float], high: Sequence[float], key: str, names: str) -> Iterator[Finding]:
    """Findings where a corner does not lie beyond the other along every axis."""
    for axis, (least, greatest) in enumerate(zip(low, high, strict=True)):
        if not least < greatest:
            yield (key, axis), Message("out-of-bounds", f"must be > {least:g}, the {names[axis]} of the other corner")


def is_zero(vector: Sequence[float]) -> bool:
    """Whether a vector has no direction."""
    return not any(vector)
