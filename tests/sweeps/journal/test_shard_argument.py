"""``--shard`` is part and parts, and nothing that is only nearly so."""

from __future__ import annotations

import argparse

import pytest

from mbla.cli.options import shard


def test_part_and_parts() -> None:
    assert [shard(text) for text in ("1/1", "2/8", "08/8")] == [(1, 1), (2, 8), (8, 8)]


@pytest.mark.parametrize(
    "text", ["", "2", "0/8", "9/8", "1/0", "-1/8", "1/8/2", " 1/8", "1/8\n", "1_0/20", "1.0/2", "²/8"]
)
def test_what_is_none_is_refused(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="is not a shard, such as 2/8"):
        shard(text)
