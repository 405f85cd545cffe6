"""Values of a point as ``key.path=value`` texts, as the reader of decks takes them."""

from __future__ import annotations

import json
from collections.abc import Mapping

from mbla.sweeps.plan import Plain


def override_texts(settings: Mapping[str, Plain]) -> tuple[str, ...]:
    """One text for each key path; JSON is YAML, and writes floats so that they are read back to the same bits."""
    return tuple(f"{key}={_written(value)}" for key, value in settings.items())


def _written(value: Plain) -> str:
    """JSON that YAML reads alike: it knows no pairs of surrogates, and takes U+0085 for the end of a line."""
    return json.dumps(value, allow_nan=False, ensure_ascii=False).replace("\x85", "\\u0085")
