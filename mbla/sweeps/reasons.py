"""Reasons of points without the folders of this machine: the same sweep says the same in every folder."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

from mbla.deck.overrides import LABEL
from mbla.sweeps.plan import Outcome, Plan

BEGINS = r"""(?<![^\s'"(=:,;])"""
"""where a path may begin in a text"""
SETTING = re.compile(rf"(?<!\S){re.escape(LABEL)}:[0-9]+:[0-9]+ ")
"""place of a value that a point sets: the user did not write it; its key and value stand behind it"""


@dataclass(frozen=True)
class ShownFolders:
    """How the folders of a sweep are shown.

    folders : a folder as this machine has it, with a stroke at its end, and what is shown in its place; the longest
              first
    """

    folders: tuple[tuple[str, str], ...]

    def in_outcome(self, outcome: Outcome) -> Outcome:
        """The same outcome with these folders shown so in its reason."""
        reason = SETTING.sub("", outcome.reason)
        for folder, shown in self.folders:
            reason = shown.join(re.split(BEGINS + re.escape(folder), reason))
        return replace(outcome, reason=reason)


def shown_folders(plan: Plan, deck: str) -> ShownFolders:
    """The base deck's folder as ``deck``, the path in the sweep file, has it; nothing for that of the sweep's files."""
    named = Path(deck).parent
    folders = {Path(plan.folder): "", Path(plan.deck).parent: "" if named == Path() else f"{named}/"}
    own = {
        f"{str(each).rstrip('/')}/": shown for folder, shown in folders.items() for each in (folder, folder.resolve())
    }
    return ShownFolders(tuple(sorted(own.items(), key=lambda item: -len(item[0]))))
