"""A picture as bytes: for notebooks, and to be embedded in pages."""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from mbla.errors import UsageError
from mbla.results.disk import write_complete

MIME = {"png": "image/png", "svg": "image/svg+xml", "pdf": "application/pdf"}


@dataclass(frozen=True)
class EncodedPicture:
    """A picture; ``content`` is what its file would hold."""

    format: str
    content: bytes = field(repr=False)

    def save(self, path: str | Path) -> Path:
        """Write it; the suffix must be that of its format.

        Raises FileError if that fails, UsageError for another suffix.
        """
        path = Path(path)
        if path.suffix.lower() != f".{self.format}":
            raise UsageError("output-format", f"{path}: the picture is {self.format}; ask picture() for another format")
        write_complete(path, self.content)
        return path

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str | bytes]:
        if self.format == "svg":
            return {MIME["svg"]: self.content.decode("utf-8")}
        return {MIME[self.format]: self.content}

    @property
    def data_uri(self) -> str:
        """For the source of an image in a page."""
        return f"data:{MIME[self.format]};base64,{base64.b64encode(self.content).decode('ascii')}"


def drawn_image(format: str, write: Callable[[Path], None]) -> EncodedPicture:
    """What a drawing writes to a file of that format; raises as it does."""
    with tempfile.TemporaryDirectory(prefix="mbla-") as folder:
        path = Path(folder) / f"picture.{format}"
        write(path)
        return EncodedPicture(format, path.read_bytes())
