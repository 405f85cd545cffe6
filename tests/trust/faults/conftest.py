"""The process that runs the commands."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.trust.faults.commands import Commands
from tests.trust.faults.mounts import keep_mounts_to_ourselves


@pytest.fixture(scope="session")
def commands(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Commands]:
    keep_mounts_to_ourselves()
    with Commands(tmp_path_factory.mktemp("faults")) as running:
        yield running


@pytest.fixture(scope="session")
def faulty(commands: Commands) -> Commands:
    """Commands whose calls can be made to fail."""
    if commands.shim is None:
        pytest.skip("no C compiler: calls cannot be made to fail where libraries written in C make them")
    return commands
