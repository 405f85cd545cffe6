"""What messages call a kind of file that is read as YAML, and what they advise there."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FileKind:
    """One kind of file.

    name     : after ``a``, in a sentence
    begins   : key and value that such a file has first
    includes : its key `include` names files that are merged into it
    large    : what to do with a file that is too large
    alias    : what to write instead of an alias
    merge    : what to write instead of a merge key
    """

    name: str
    begins: str
    includes: bool
    large: str
    alias: str
    merge: str


DECK = FileKind(
    name="deck",
    begins="mbla: 1",
    includes=True,
    large="put large geometry in a mesh file (`mesh: {file: ...}`)",
    alias="write the value out, or use a parameter",
    merge="use `include` or a parameter",
)
