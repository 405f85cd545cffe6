"""Sharing changes no bit of any answer, whatever was solved before in the same process."""

from __future__ import annotations

import random

import pytest

from mbla.sharing import sharing
from mbla.studies.sweep.worker.memory import Memory
from tests.studies.sweep.worker.sharing_decks import ARCH, SMALL_ARCH, VARIED, Settings, solved

POINTS = [(deck, settings) for deck, variants in VARIED.items() for settings in variants]


def in_random_order(points: list[tuple[str, Settings]], seed: int) -> list[tuple[str, Settings]]:
    order = [*points, *points]
    random.Random(seed).shuffle(order)
    return order


def differing(points: list[tuple[str, Settings]], memory: Memory) -> list[str]:
    """Points whose answer with what ``memory`` keeps is another one, or another error, than from scratch."""
    alone: dict[str, str] = {}
    different = []
    for deck, settings in points:
        name = f"{deck} {settings}"
        if name not in alone:
            alone[name] = solved(deck, settings)
        with sharing(memory):
            if solved(deck, settings) != alone[name]:
                different.append(name)
    return different


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_every_kind_of_deck_and_setting_is_answered_as_from_scratch(seed: int) -> None:
    memory = Memory()
    assert not differing(in_random_order(POINTS, seed), memory)
    assert set(memory.found) >= {"structure", "contacts", "standing"}


@pytest.mark.long
def test_with_room_for_two_results_too() -> None:
    memory = Memory(most_results=2)
    assert not differing(in_random_order(POINTS, 5), memory)
    assert len(memory) <= 2


def test_points_of_an_arch_are_answered_as_from_scratch() -> None:
    friction_and_direction: list[tuple[str, Settings]] = [
        (ARCH, {**SMALL_ARCH, "parameters.mu": mu, "load_cases.push_x.live.0.acceleration": direction})
        for mu in (0.6, 0.5)
        for direction in ([1.0, 0.0, 0.0], [0.6, 0.8, 0.0])
    ]
    too_thin = (ARCH, {**SMALL_ARCH, "parameters.t": 0.02})
    points = [*friction_and_direction, too_thin, *reversed(friction_and_direction)]
    memory = Memory()
    assert not differing(points, memory)
    assert memory.found["structure"] >= 6, memory
    assert memory.found["contacts"] >= 6, memory
    assert memory.found["standing"] >= 4, memory
