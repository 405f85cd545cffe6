"""Kinds register by name, and stand in the order of the schema."""

from __future__ import annotations

import pytest

from mbla.deck.kinds.kinds import Choice, ChoiceKind, in_order, keys_of, register
from mbla.deck.section import Section


def kinds(*pairs: tuple[str, str]) -> dict[str, ChoiceKind]:
    found: dict[str, ChoiceKind] = {}
    for name, after in pairs:
        register(found, ChoiceKind(name, Section, after=after))
    return found


def test_each_stands_behind_the_one_it_names_others_by_name() -> None:
    found = kinds(("tower", ""), ("pier", "arch"), ("vault", "pier"), ("arch", ""), ("dome", "arch"))
    assert [kind.name for kind in in_order(found)] == ["arch", "dome", "pier", "vault", "tower"]


def test_a_name_registers_once() -> None:
    with pytest.raises(ValueError, match="arch is registered already"):
        kinds(("arch", ""), ("arch", ""))


@pytest.mark.parametrize("after", ["dome", "arch"])
def test_no_order_behind_a_kind_that_is_not_there(after: str) -> None:
    with pytest.raises(ValueError, match="no order of arch"):
        in_order(kinds(("arch", after), ("pier", "")))


def test_a_choice_has_a_key_for_each_of_its_kinds() -> None:
    @keys_of(kinds(("arch", ""), ("pier", "")))
    class ArchOrPier(Choice):
        """One of two."""

    part = ArchOrPier.model_validate({"pier": {}})
    assert (part.kind, part.chosen) == ("pier", Section())
    with pytest.raises(ValueError, match="dome"):
        ArchOrPier.model_validate({"dome": {}})
