"""The process that runs the commands, and the deck over whose earlier result they run."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator

import pytest

from tests.trust.faults.scene import IMPORTED, Scene
from tests.trust.processes import Commands

CLONE_NEWNS, MS_REC, MS_PRIVATE = 0x20000, 1 << 14, 1 << 18


@pytest.fixture(scope="session")
def commands() -> Iterator[Commands]:
    """Mounts that are made from here on are those of these processes alone, where the system lets them be."""
    if sys.platform == "linux":
        library = ctypes.CDLL(None, use_errno=True)
        if library.unshare(CLONE_NEWNS) == 0 and library.mount(b"none", b"/", None, MS_REC | MS_PRIVATE, None):
            raise OSError(ctypes.get_errno(), "mounts cannot be made private")
    with Commands(IMPORTED) as running:
        yield running


@pytest.fixture(scope="session")
def scene(commands: Commands, tmp_path_factory: pytest.TempPathFactory) -> Scene:
    return Scene(commands, tmp_path_factory.mktemp("scene"))
