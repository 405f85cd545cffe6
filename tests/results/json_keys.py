"""Every key path of a JSON record, as its documentation names them."""

from __future__ import annotations

from collections.abc import Container, Iterator
from typing import Any


def values_below(value: Any, known: Container[str], path: str = "") -> Iterator[tuple[str, Any]]:
    """Paths and values below a value: ``[]`` each item of a list, ``*`` each key that is not known by its own name."""
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, item in value.items():
            own = f"{path}.{key}" if path else key
            yield from values_below(item, known, own if own in known or f"{path}.*" not in known else f"{path}.*")
    if isinstance(value, list):
        for item in value:
            yield from values_below(item, known, f"{path}[]")
