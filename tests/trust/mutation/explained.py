"""Survivors that no test can kill, with the reason: they are no other program, or not a worse one.

Each is named by module, text of its line, and change.
"""

from __future__ import annotations

EXPLAINED: dict[tuple[str, str, str], str] = {}
