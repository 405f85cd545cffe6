"""The seal at the end of a result file: a check sum over every byte before it, checked before HDF5 sees the file.

HDF5 itself protects arrays and object headers, but not all of its own tables, and anybody can change a figure with it
and have new check sums written. Its library may also crash on a file that is not as it should be. So a file whose bytes
are not those that were written is refused before it is opened. The seal stands behind the end that HDF5 knows of, which
HDF5 permits and ignores; a program that changes the file through HDF5 cuts the seal off.

The seal is no signature: who wants to forge a result can seal it anew. ``mbla verify`` believes no figure for its seal.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import BinaryIO

from mbla.errors import FileError

HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
LABEL = b"\nmbla sha256 of all bytes before this line "
SEAL_BYTES = len(LABEL) + 64 + 1
PIECE_BYTES = 1 << 20


def sealed(image: bytes) -> bytes:
    """A file with its seal; ``image`` is the file without."""
    return image + _seal(hashlib.sha256(image).hexdigest())


def check_seal(path: Path) -> None:
    """Read a file once, in pieces, and compare it with its seal.

    Raises
    ------
    FileError
        It is no HDF5 file, carries no seal, or is not what was sealed.
    OSError
        It cannot be read.
    """
    with path.open("rb") as file:
        if file.read(len(HDF5_SIGNATURE)) != HDF5_SIGNATURE:
            raise FileError("damaged-result-file", f"{path}: not an HDF5 file")
        length = file.seek(0, os.SEEK_END) - SEAL_BYTES
        file.seek(max(length, 0))
        seal = file.read(SEAL_BYTES + 1)
        if length < 0 or not seal.startswith(LABEL):
            raise FileError(
                "damaged-result-file",
                f"{path}: no check sum at its end: cut off or changed since it was written, of a layout before "
                "version 5, or not an mbla result file: run the deck again",
            )
        if seal != _seal(_digest(file, length)):
            raise FileError(
                "damaged-result-file",
                f"{path}: damaged or changed since it was written, its check sum does not fit: run the deck again",
            )


def _seal(digest: str) -> bytes:
    return LABEL + digest.encode("ascii") + b"\n"


def _digest(file: BinaryIO, length: int) -> str:
    """SHA-256 of the first bytes of a file, in hex."""
    digest, left = hashlib.sha256(), length
    file.seek(0)
    while left > 0 and (piece := file.read(min(left, PIECE_BYTES))):
        digest.update(piece)
        left -= len(piece)
    return digest.hexdigest()
