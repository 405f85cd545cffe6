"""Names of a file's objects, groups, sets and layers as names that a deck can write."""

from __future__ import annotations

import re
import unicodedata

LONGEST = 64


def member_name(text: str) -> str:
    """A name with letters, digits and ``. _ -`` only; empty for an empty one.

    >>> member_name("Gewölbe 1"), member_name("Mesh1 Group1 Model"), member_name(".x")
    ('Gewolbe_1', 'Mesh1_Group1_Model', '_.x')
    """
    # letters with marks become plain ones; those of other alphabets go
    plain = unicodedata.normalize("NFKD", text.strip()).encode("ascii", "ignore").decode("ascii")
    name = re.sub(r"[^A-Za-z0-9_.-]+", "_", plain)
    if not name and text.strip():
        name = "_"
    return ("_" + name if name[:1] in (".", "-") else name)[:LONGEST]
