"""A picture as bytes that a notebook shows."""

from __future__ import annotations

import base64
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from mbla.errors import UsageError
from mbla.results.results import CaseResult, Results
from mbla.results.whole_file import write_whole

MIME = {"png": "image/png", "svg": "image/svg+xml", "pdf": "application/pdf"}


@dataclass(frozen=True)
class Picture:
    """A picture; ``content`` is what its file would hold."""

    format: str
    content: bytes = field(repr=False)

    def save(self, path: str | Path) -> Path:
        """Write it; the suffix must be that of its format. FileError if that fails, UsageError for another suffix."""
        path = Path(path)
        if path.suffix.lower() != f".{self.format}":
            raise UsageError("output-format", f"{path}: the picture is {self.format}; ask picture() for another format")
        write_whole(path, self.content)
        return path

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str | bytes]:
        if self.format == "svg":
            return {MIME["svg"]: self.content.decode("utf-8")}
        return {MIME[self.format]: self.content}

    @property
    def data_uri(self) -> str:
        """For the source of an image in a page."""
        return f"data:{MIME[self.format]};base64,{base64.b64encode(self.content).decode('ascii')}"


def case_picture(results: Results, case: CaseResult, kind: str, path: Path | None, format: str | None) -> Picture:
    """Draw a case, to a file too if a path is given; raises as :meth:`Case.picture`."""
    from mbla.results.pictures.options import format_of
    from mbla.results.pictures.plot import plot_case

    if path is None:
        ending = format_of(Path(f"picture.{format or 'png'}"))
    else:
        ending = format_of(path)
        if format not in (None, ending):
            raise UsageError(
                "output-format", f"{path}: its suffix says {ending}, the format {format}: give one of them"
            )
    with tempfile.TemporaryDirectory(prefix="mbla-") as folder:
        drawn = Path(folder) / f"picture.{ending}"
        plot_case(results, case, drawn, kind)
        picture = Picture(ending, drawn.read_bytes())
    if path is not None:
        write_whole(path, picture.content)
    return picture
