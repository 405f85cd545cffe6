"""What fuzzing found: one file for each place in the program where something went wrong, with what went wrong."""

from __future__ import annotations

import json
import traceback
from dataclasses import asdict, dataclass, field
from pathlib import Path

from tests.trust.hostile import subject


@dataclass
class Finds:
    """Files given, and how they ended; those that broke the program are kept in a folder.

    runs  : files given
    ended : how often, by kind and ending
    found : in words, by kind of error and place in the program
    """

    folder: Path
    runs: int = 0
    ended: dict[str, int] = field(default_factory=dict)
    found: dict[str, str] = field(default_factory=dict)

    def give(self, kind: str, content: bytes, folder: Path) -> None:
        """Give a file to the program; keep it if that is the first that breaks it in that place."""
        self.runs += 1
        try:
            ending = f"{kind} {subject.give(kind, content, folder)}"
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            ending = f"{kind} BROKEN"
            self._keep(kind, content, error)
        self.ended[ending] = self.ended.get(ending, 0) + 1

    def _keep(self, kind: str, content: bytes, error: BaseException) -> None:
        frames = traceback.extract_tb(error.__traceback__)
        inside = [frame for frame in frames if "/mbla/" in frame.filename] or frames
        place = f"{type(error).__name__} at {Path(inside[-1].filename).name}:{inside[-1].lineno}"
        if place not in self.found:
            self.folder.mkdir(parents=True, exist_ok=True)
            path = self.folder / f"{len(self.found) + 1:03}.{kind}"
            path.write_bytes(content)
            self.found[place] = f"{place}: {str(error)[:300]} (see {path})"

    @classmethod
    def resumed(cls, record: Path, folder: Path) -> Finds:
        """Those of a run that was interrupted; none where there is no record of one."""
        earlier = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
        return cls(**{**earlier, "folder": folder})

    def write(self, record: Path) -> None:
        """Keep what is known so far; a run that is killed leaves the record before whole."""
        new = record.with_suffix(".new")
        new.write_text(json.dumps({**asdict(self), "folder": str(self.folder)}, indent=2) + "\n", encoding="utf-8")
        new.replace(record)

    def accepted(self) -> int:
        """Files that were taken as models."""
        return sum(count for ending, count in self.ended.items() if ending.endswith(" accepted"))
