"""Result files that were damaged bring no command down, and ``mbla verify`` agrees with none forged."""

from __future__ import annotations

import itertools
import json
import random
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError
from mbla.verify import verify_file
from tests.trust.corrupted.files import FORGED, claims_changed, content_of, is_proof, write_decks
from tests.trust.corrupted.spoiling import DAMAGES, damaged, forge
from tests.trust.counts import record_counts
from tests.trust.processes import Commands, Ended

DAMAGED_FILES, FORGERIES = 210, 300
"""the first: thirty of each kind of damage"""
SMALL = ("beam_on_three_supports", "plank_in_clamp", "incline_too_steep")
"""decks whose results are damaged; plane ones, as drawing in space takes seconds"""
IMPORTED = (
    *("mbla.results.diff.comparison", "mbla.results.diff.words", "mbla.results.exit_status", "mbla.verify"),
    *("mbla.results.hdf5.result_file", "mbla.results.listing.listing", "mbla.results.tables.tables"),
)
DRAWING = (
    *("matplotlib.pyplot", "matplotlib.backends.backend_svg", "matplotlib.backends.backend_agg", "jinja2"),
    *("mbla.results.pictures.plot", "mbla.results.report.report"),
)
LIMITS = {"RLIMIT_AS": 4 << 30, "RLIMIT_CORE": 0, "RLIMIT_CPU": 60}
REFUSED = 6
STATUSES = (0, 4, 5, REFUSED)
"""documented for commands on results; 5 and 4 from verify, 4 from diff"""
MOST_SECONDS = 5.0
"""of processor time until a file is refused"""
MOST_MB = 2048.0

# --- damaged: no command may crash, and all must refuse a file that one refuses ----------------------


def commands(path: Path, good: Path, out: Path) -> dict[str, tuple[str | Path, ...]]:
    """Arguments of every command that reads a result file; ``good`` is another to compare with."""
    return {
        "show": ("show", path),
        "verify": ("verify", path, "--json"),
        "diff": ("diff", path, good),
        "export": ("export", path, "--csv", "-o", out / "tables", "--force"),
        "plot": ("plot", path, "-o", out / "pictures", "--kind", "mechanism", "--format", "svg"),
        "report": ("report", path, "-o", out / "report.html", "--no-3d"),
    }


def faults_of(path: Path, ended: Ended) -> list[str]:
    """What is wrong with how a command ended, whatever the file."""
    faults = []
    if ended.status not in STATUSES:
        faults.append(f"exit status {ended.status}")
    if "Traceback" in ended.err or "Warning" in ended.err:
        faults.append("traceback or warning")
    if ended.memory > MOST_MB:
        faults.append(f"{ended.memory:.0f} MB")
    if ended.status == REFUSED:
        said_nothing = not ended.out or json.loads(ended.out)["exit_code"] == REFUSED
        if len(ended.err.splitlines()) != 1 or str(path) not in ended.err or not said_nothing:
            faults.append("a refusal that is not one line about the file")
        if ended.seconds > MOST_SECONDS:
            faults.append(f"refused after {ended.seconds:.1f} s")
    return [f"{fault}: {ended.err.strip()[-300:]}" for fault in faults]


def given_to_commands(
    running: Commands, original: Path, path: Path, left_out: Collection[str]
) -> tuple[Counter[str], list[str]]:
    """A damaged copy of a file given to every command: what became of it, and what is wrong with that."""
    asked = commands(path, original, path.parent / "out")
    ended = {name: running.run(*arguments) for name, arguments in asked.items() if name not in left_out}
    wrong = [f"{name}: {fault}" for name, each in ended.items() for fault in faults_of(path, each)]
    counts = Counter({"files": 1, "commands": len(ended)})
    verified = ended["verify"]
    if ended["show"].status == REFUSED:
        taken = [name for name, each in ended.items() if each.status != REFUSED]
        wrong += [f"show refuses it, {name} does not" for name in taken]
        counts["refused"] += 1
    elif verified.status == REFUSED or not (verified.out and json.loads(verified.out).get("agrees")):
        counts["disagreed"] += 1
    else:
        counts["without effect"] += 1
        known = content_of(original)
        found = {key: value for key, value in content_of(path).items() if key in known}
        changed = [claim for claim in claims_changed(known, found) if not is_proof(claim, found)]
        wrong += [f"verify agrees with another claim: {claim}" for claim in changed[:3]]
    return counts, wrong


def spoilt(
    running: Commands, folder: Path, originals: Iterable[Path], damages: int, left_out: Collection[str] = ()
) -> tuple[Counter[str], list[str]]:
    """So many damaged files; ``left_out`` are commands."""
    counts: Counter[str] = Counter()
    wrong = []
    cycle, path, generator = itertools.cycle(originals), folder / "spoilt.h5", random.Random(3)
    for kind in itertools.islice(itertools.cycle(DAMAGES), damages):
        original = next(cycle)
        path.write_bytes(damaged(original.read_bytes(), kind, generator))
        done, faults = given_to_commands(running, original, path, left_out)
        counts += done
        wrong += [f"{kind}, {original.stem}, {fault}" for fault in faults]
    return counts, wrong


@pytest.mark.long
def test_some_spoilt_files(tmp_path: Path) -> None:
    """One of each kind of damage, given to commands that draw nothing."""
    originals = write_decks(tmp_path, ("incline_too_steep",)).values()
    with Commands(IMPORTED, LIMITS) as running:
        counts, wrong = spoilt(running, tmp_path, originals, len(DAMAGES), ("plot", "report"))
    assert not wrong, "\n".join(wrong)
    assert counts["refused"] >= len(DAMAGES) - 1


@pytest.mark.trust
def test_many_spoilt_files(tmp_path: Path) -> None:
    originals = write_decks(tmp_path, SMALL).values()
    with Commands((*IMPORTED, *DRAWING), LIMITS) as running:
        counts, wrong = spoilt(running, tmp_path, originals, DAMAGED_FILES)
    assert not wrong, "\n".join([f"{len(wrong)} faults", *wrong[:60]])
    record_counts(
        "corrupted-results",
        60,
        "A result file that was damaged after the run brings no command down: all refuse it, or `mbla "
        "verify` disagrees with it, or the change leaves every claim as it was",
        {
            "damaged files": counts["files"],
            "commands run on them": counts["commands"],
            "files refused by every command": counts["refused"],
            "files that verify refuses or disagrees with": counts["disagreed"],
            "files whose claims the change left as they were": counts["without effect"],
            "crashes, or other claims that verify agreed with": len(wrong),
        },
    )


# --- forged: verify agrees with no claim that was changed ----------------------------------------------------------


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


def forgeries(folder: Path, originals: Mapping[str, Path], number: int, seed: int) -> tuple[Counter[str], list[str]]:
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


@pytest.mark.long
def test_some_forgeries(tmp_path: Path) -> None:
    originals = write_decks(tmp_path, ("bar_between_walls",))
    assert verify_file(originals["bar_between_walls"])[1] == ()
    counts, wrong = forgeries(tmp_path, originals, 8, seed=1)
    assert not wrong, "\n".join(wrong)
    assert counts["disagreed"] + counts["refused"] >= 4


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
    counts, wrong = forgeries(tmp_path, write_decks(tmp_path, tuple(FORGED)), FORGERIES, seed=2)
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
