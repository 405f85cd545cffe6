"""The text of decks/tradeoff/README.md from the rows of measured.csv."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from statistics import median

from tests.decks.tradeoff_record import Entry
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET

HEAD = """\
# Speed against accuracy, measured

This page and its pictures are made by one command, `python -m tests.decks.tradeoff_page` (with names of structures it
renews these alone), from [measured.csv](measured.csv): every structure of the standard set under the settings that a
deck can choose, as `mbla tradeoff DECK` measures any other deck. Each setting ran in a process of its own with one
thread; time is that of assembling, solving and verifying one load case, the shortest of up to three runs, without
reading the deck and finding contacts. Memory is what the process held at most beyond its imports.

The *error* is the relative distance of the load factor from that of `accuracy: reference`, or of the sharpest verified
run where that is not verified; `<` marks distances below what the reference itself is good to. *Front*: no verified run
is both faster and nearer. Runs that were stopped, failed or are not verified stand in the tables and are never on the
front. Other models (flow rule, contact model, contact points) answer another question: their difference is no error.
Without dilatancy the load factor need not be unique: distances between schemes may be other solutions of the same law.
"""
PRESETS = ("draft", "standard", "reference")
RULES = {"associative": "associative", "non_associative": "without dilatancy"}


def page_text(entries: Sequence[Entry]) -> str:
    """The whole page."""
    lines = [HEAD.rstrip()]
    if not entries:
        return "\n".join([*lines, "", "Nothing is measured yet.", ""])
    lines += ["", "## The presets over the set", "", *_summary(entries)]
    lines += [
        f"![{RULES[rule]}](presets_{rule}.png)" for rule in FLOW_RULES if any(e.flow_rule == rule for e in entries)
    ]
    lines += ["", *_missing(entries)]
    for structure in STANDARD_SET:
        for rule in FLOW_RULES:
            own = [entry for entry in entries if (entry.structure, entry.flow_rule) == (structure.name, rule)]
            if own:
                lines += ["", f"## {structure.name}, {RULES[rule]}", "", *_table(own), "", *_marks(own)]
    return "\n".join(lines) + "\n"


def _summary(entries: Sequence[Entry]) -> Iterator[str]:
    """For each flow rule and preset: on how many structures it is verified, its errors, its time."""
    heads = "flow rule | preset | structures | verified | largest error | median error | time against standard, median"
    yield f"| {heads} | slowest |"
    yield "|---|---|---|---|---|---|---|---|"
    for rule in FLOW_RULES:
        times = {e.structure: e.time for e in _of(entries, rule, "standard") if not math.isnan(e.time)}
        for preset in PRESETS:
            own = _of(entries, rule, preset)
            if not own:
                continue
            sure = [e for e in own if e.verified]
            errors = [(e.error, e.structure) for e in sure if not math.isnan(e.error)]
            ratios = [e.time / times[e.structure] for e in own if e.structure in times and not math.isnan(e.time)]
            slowest = max(((e.time, e.structure) for e in own if not math.isnan(e.time)), default=(math.nan, "-"))
            worst = max(errors, default=(math.nan, "-"))
            yield (
                f"| {RULES[rule]} | {preset} | {len(own)} | {len(sure)} | {_small(worst[0])} ({worst[1]}) | "
                f"{_small(median(error for error, _ in errors) if errors else math.nan)} | "
                f"{f'{median(ratios):.2f} times' if ratios else '-'} | {_seconds(slowest[0])} s ({slowest[1]}) |"
            )
    yield ""


def _of(entries: Sequence[Entry], rule: str, preset: str) -> list[Entry]:
    return [e for e in entries if e.flow_rule == rule and e.rung == f"accuracy: {preset}"]


def _missing(entries: Sequence[Entry]) -> Iterator[str]:
    """Structures of the set that were not measured: their absence must not look like a result."""
    known = {(entry.structure, entry.flow_rule) for entry in entries}
    missing = [f"{s.name} ({RULES[rule]})" for s in STANDARD_SET for rule in FLOW_RULES if (s.name, rule) not in known]
    if missing:
        yield f"Not measured yet: {'; '.join(missing)}."


def _table(entries: Sequence[Entry]) -> Iterator[str]:
    """The runs of one structure with one flow rule, other models last."""
    yield (
        "| setting | time [s] | solver [s] | iterations | memory [MB] | load factor | error | static bound | "
        "kinematic bound | residual | |"
    )
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for entry in sorted(entries, key=lambda entry: bool(entry.other_model)):
        if not entry.status:
            yield f"| {entry.rung} | - | - | - | - | - | - | - | - | - | {entry.end} |"
            continue
        yield (
            f"| {entry.rung} | {_seconds(entry.time)} | {_seconds(entry.solver_time)} | {entry.iterations} | "
            f"{entry.memory:.1f} | {_digits(entry.load_factor, 6)} | {_error(entry)} | "
            f"{_digits(entry.static_bound, 8)} | {_digits(entry.kinematic_bound, 8)} | "
            f"{_small(entry.residual)} | {_mark(entry)} |"
        )


def _marks(entries: Sequence[Entry]) -> Iterator[str]:
    """When and with what it was measured."""
    last = entries[-1]
    yield f"Measured {last.date}, {last.machine}; {last.versions}. Reading, model and contacts: " + (
        f"{_seconds(min((e.preparation_time for e in entries if e.preparation_time > 0), default=math.nan))} s more."
    )


def _error(entry: Entry) -> str:
    if entry.reference or math.isnan(entry.distance):
        return "-"
    return f"<{_small(entry.resolution)}" if entry.distance < entry.resolution else _small(entry.distance)


def _mark(entry: Entry) -> str:
    words = ["reference"] * entry.reference + ["front"] * entry.front
    words += [f"other model: {entry.other_model}"] if entry.other_model else []
    words += [] if entry.status == "solved" else [entry.status.replace("_", " ")]
    words += [] if entry.verified or entry.status != "solved" else ["not verified"]
    return ", ".join(words)


def _seconds(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.3g}"


def _digits(value: float, digits: int) -> str:
    return "-" if math.isnan(value) else f"{value:.{digits}g}"


def _small(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.1e}"
