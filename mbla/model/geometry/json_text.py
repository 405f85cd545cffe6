"""JSON of geometry files, read without a guess."""

from __future__ import annotations

import json
from typing import Any


def parse_json(content: bytes) -> Any:
    """The document; of a key that an object has twice neither value is taken.

    Raises
    ------
    ValueError
        for text that is no JSON in UTF-8, and for keys that are there twice
    RecursionError
        for text that is nested too deeply
    """
    return json.loads(content.decode("utf-8-sig"), object_pairs_hook=_without_twins)


def _without_twins(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    entries = dict(pairs)
    if len(entries) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise ValueError(f"an object has the key {twice[:40]!r} twice")
    return entries
