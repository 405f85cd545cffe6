"""Warnings and remarks of a report: gathered by identifier, each kind explained once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mbla.errors import Notice
from mbla.results.explanations import Explanation, explanations


@dataclass(frozen=True)
class NoticeKind:
    """All notices of one identifier and severity; ``explanation`` is None where nothing is known of it."""

    severity: str
    identifier: str
    messages: tuple[str, ...]
    explanation: Explanation | None


def notice_kinds(notices: Sequence[Notice]) -> list[NoticeKind]:
    """Warnings before remarks, otherwise in the order in which they first appear."""
    messages: dict[tuple[str, str], list[str]] = {}
    for notice in sorted(notices, key=lambda each: each.severity != "warning"):
        messages.setdefault((notice.severity, notice.identifier), []).append(notice.message)
    return [
        NoticeKind(severity, identifier, tuple(texts), explanations().get(identifier))
        for (severity, identifier), texts in messages.items()
    ]
