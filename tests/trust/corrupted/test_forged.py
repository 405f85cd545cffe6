"""``mbla verify`` agrees with no forged file whose claims were changed."""

from __future__ import annotations

import itertools
import random
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError
from mbla.results.verify import verify_file
from tests.trust.corrupted.forged import claims_changed, content_of, forge, is_proof, write_decks
from tests.trust.counts import record_counts

FORGERIES = 300


def judged(path: Path, original: Path) -> tuple[str, list[str]]:
    """What became of a forged file, and claims with which verify agrees although they were changed."""
    try:
        _, disagreements = verify_file(path)
    except FileError:
        return "refused", []
    if disagreements:
        return "disagreed", []
    forged = content_of(path)
    changed = claims_changed(content_of(original), forged)
    return ("proved" if changed else "told"), [claim for claim in changed if not is_proof(claim, forged)]


def counted(folder: Path, originals: Mapping[str, Path], number: int, seed: int) -> tuple[Counter[str], list[str]]:
    """Forgeries of files in turn: what became of them, and what is wrong."""
    generator = random.Random(seed)
    counts: Counter[str] = Counter()
    wrong = []
    path = folder / "forged.h5"
    for row, (name, original) in zip(range(number), itertools.cycle(originals.items()), strict=False):
        said = forge(original, path, generator)
        became, changed = judged(path, original)
        counts[became] += 1
        wrong += [f"{row}, {name}, {said}: verify agrees with {place}" for place in changed[:1]]
    return counts, wrong


def test_some_forgeries(tmp_path: Path) -> None:
    originals = write_decks(tmp_path, ("several", "bar_between_walls"))
    for path in originals.values():
        assert verify_file(path)[1] == ()
    counts, wrong = counted(tmp_path, originals, 12, seed=1)
    assert not wrong, "\n".join(wrong)
    assert counts["disagreed"] + counts["refused"] >= 6


@pytest.mark.parametrize(
    ("key", "value", "claim"),
    [
        (("cases/a@1/load_factor", ""), 0.5 * (1 + 1e-5), "cases/a@1/load_factor"),
        (("cases/a@1/load_factor", ""), 0.5 * (1 + 1e-7), None),
        (("cases/a@1/load_factor", "units"), b"m", "cases/a@1/load_factor@units"),
        (("cases/a@1/reason", ""), b"none", None),
        (("cases/a@1/reason", "units"), b"m", "cases/a@1/reason@units"),
        (("cases/a@1/standing/verdict", ""), b"yes", "cases/a@1/standing/verdict"),
        (("cases/a@1/standing/verdict", ""), b"doubtful", None),
        (("model/title", ""), b"forged", "model/title"),
        (("", "created"), b"2020", None),
        (("", "deck_sha256"), b"00", "@deck_sha256"),
    ],
)
def test_what_is_a_changed_claim(key: tuple[str, str], value: Any, claim: str | None) -> None:
    of_case = {("cases/a@1/load_factor", ""): 0.5, ("cases/a@1/reason", ""): b"", ("cases/a@1/reason", "units"): b"1"}
    of_case["cases/a@1/standing/verdict", ""] = b"only by self-stress"
    content = {**of_case, ("model/title", ""): b"x", ("", "created"): b"2026", ("", "deck_sha256"): b"ab"}
    assert claims_changed(content, content) == []
    assert claims_changed(content, content | {key: value}) == ([] if claim is None else [claim])


@pytest.mark.parametrize("rule", [b"associative", b"non_associative"])
@pytest.mark.parametrize("left", [(), ("modes",)])
def test_an_associative_answer_is_left_out_whole_where_the_case_is_its_own(rule: bytes, left: tuple[str, ...]) -> None:
    forged = {("cases/a@1/flow_rule", ""): rule, **{(f"cases/a@1/associative/{name}", ""): 0 for name in left}}
    assert is_proof("cases/a@1/associative/load_factor", forged) == (rule == b"associative" and not left)
    assert is_proof("cases/a@1/lock", forged)
    assert not is_proof("cases/a@1/load_factor", forged)
    assert not is_proof("model/title", forged)


@pytest.mark.trust
def test_three_hundred_forgeries(tmp_path: Path) -> None:
    counts, wrong = counted(tmp_path, write_decks(tmp_path), FORGERIES, seed=2)
    assert not wrong, "\n".join([f"{len(wrong)} faults", *wrong])
    record_counts(
        "forged-results",
        61,
        "`mbla verify` agrees with no result file in which any dataset or attribute was changed, removed or swapped "
        "between load cases, unless it is marked as not verified",
        {
            "forgeries": FORGERIES,
            "files that verify disagrees with": counts["disagreed"],
            "files refused": counts["refused"],
            "files forged only in what is marked as not verified, or by less than rounding": counts["told"],
            "files whose forged proof still proves the claim": counts["proved"] - len(wrong),
            "changed claims that verify agreed with": len(wrong),
        },
    )
