"""The text of decks/tradeoff/README.md from the rows of measured.csv: presets, knobs, families, what gave nothing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from statistics import median

from tests.decks.tradeoff_record import Entry
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET

HEAD = """\
# Speed against accuracy, measured

The structures of the standard set under the settings that a deck can choose, each measured as `mbla tradeoff DECK`
measures any deck: in a process of its own with one thread. Time is that of assembling, solving and verifying one load
case, the shortest of up to three runs, without reading the deck and finding contacts; memory what the process held at
most beyond its imports. The *error* is the relative distance of the load factor from that of `accuracy: reference`, or
of the sharpest verified run where that is not verified, and never told smaller than what that one is itself good to.
Without dilatancy the load factor need not be unique: a distance may be another solution of the same law.

`python -m tests.decks.tradeoff_page` measures all and writes this page (three quarters of an hour; with names of
structures only these; `--page` measures nothing). Every run, with its bounds, residual, solvers, date, versions and
machine, is a row of [measured.csv](measured.csv).
"""
PRESETS = ("draft", "standard", "reference")
PROMISED = {"draft": 1e-2, "standard": 1e-4, "reference": 1e-7}
"""errors that the presets promise; that of the reference is the distance of its bounds, associative flow only"""
STATE = 1e-6
"""residual of a state of the law"""
RULES = {"associative": "associative", "non_associative": "without dilatancy"}
STANDARD = "accuracy: standard"
NAN = math.nan


def page_text(entries: Sequence[Entry]) -> str:
    """The whole page."""
    lines = [HEAD.rstrip()]
    if not entries:
        return "\n".join([*lines, "", "Nothing is measured yet.", ""])
    lines += ["", "## The presets", "", *_summary(entries), "", *_promises(entries), ""]
    lines += [
        f"![{RULES[rule]}](presets_{rule}.png)" for rule in FLOW_RULES if any(e.flow_rule == rule for e in entries)
    ]
    lines += ["", "## What each knob buys", "", *_knobs(entries), "", "## Structure by structure", ""]
    for rule in FLOW_RULES:
        own = [entry for entry in entries if entry.flow_rule == rule]
        lines += [f"### {RULES[rule].capitalize()}", "", *_table(own), ""] if own else []
    lines += ["## What gave no verified result", "", *_failures(entries), *_missing(entries), *_origin(entries)]
    return "\n".join(lines) + "\n"


def _summary(entries: Sequence[Entry]) -> Iterator[str]:
    """For each flow rule and preset: on how many structures it is verified, its errors, its time."""
    yield "| flow rule | preset | structures | verified | largest error | median error | time of standard's | slowest |"
    yield "|---|---|---|---|---|---|---|---|"
    for rule in FLOW_RULES:
        for preset in PRESETS:
            own = _of(entries, rule, f"accuracy: {preset}")
            if not own:
                continue
            sure = [e for e in own if e.verified]
            errors = [(_reached(e), e.structure) for e in sure if not math.isnan(_reached(e))]
            slowest = max(((e.time, e.structure) for e in own if not math.isnan(e.time)), default=(NAN, "-"))
            worst, count = max(errors, default=(NAN, "-")), f"{len(own)} of {len(STANDARD_SET)}"
            yield (
                f"| {RULES[rule]} | {preset} | {count} | {len(sure)} | {_small(worst[0])} ({worst[1]}) | "
                f"{_small(median(error for error, _ in errors) if errors else NAN)} | {_ratios(entries, own)} | "
                f"{_seconds(slowest[0])} s ({slowest[1]}) |"
            )


def _reached(entry: Entry) -> float:
    """The error; of the reference what it is itself good to: its bounds, or its residual."""
    return entry.resolution if entry.reference else entry.error


def _promises(entries: Sequence[Entry]) -> Iterator[str]:
    """What the presets promise and where a verified run breaks it."""
    yield (
        "Promised are errors below 1e-2 (draft) and 1e-4 (standard), and bounds within 1e-7 of each other (reference, "
        "associative flow). Time is the median, with the least and the greatest, of the same structure's `standard`."
    )
    yield ""
    beyond = [
        e
        for preset, limit in PROMISED.items()
        for rule in FLOW_RULES
        for e in _of(entries, rule, f"accuracy: {preset}")
        if e.verified and _reached(e) > limit and (preset != "reference" or rule == "associative")
    ]
    broken = [_named(e) for e in beyond if not _is_another_state(e)]
    yield f"**Broken: {'; '.join(broken)}.**" if broken else "No verified run breaks them."
    others = [_named(e) for e in beyond if _is_another_state(e)]
    if others:
        yield ""
        yield (
            f"Another state of the law than that of the reference: {'; '.join(others)}. Both fit the law to {STATE:g} "
            "there: without dilatancy the load factor is one of many, and which one an interior path ends in depends "
            "on the rounding of sums. The presets differ in it as two machines do."
        )


def _named(entry: Entry) -> str:
    return f"{entry.rung} on {entry.structure} ({RULES[entry.flow_rule]}, {_small(_reached(entry))})"


def _is_another_state(entry: Entry) -> bool:
    """Whether a distance from the reference is that of two solutions, as the law's own residuals tell."""
    return entry.flow_rule != "associative" and entry.residual <= STATE and entry.resolution <= STATE


def _knobs(entries: Sequence[Entry]) -> Iterator[str]:
    """Every setting beside the presets: its time against standard, its error or, of other models, its difference."""
    yield (
        "One knob turned away from the deck's own settings (`standard`), on the structures where it was tried. Other "
        "models (flow rule, contact model, contact points) answer another question: their difference is no error."
    )
    yield ""
    yield "| flow rule | setting | structures | verified | time of standard's | median error | largest error |"
    yield "|---|---|---|---|---|---|---|"
    for rule in FLOW_RULES:
        names = dict.fromkeys(e.rung for e in entries if e.flow_rule == rule and not e.rung.startswith("accuracy: "))
        own = {name: _of(entries, rule, name) for name in names}
        for name in sorted(own, key=lambda name: any(e.other_model for e in own[name])):
            runs = own[name]
            errors = [(e.error, e.structure) for e in runs if e.load_factor == e.load_factor and e.error == e.error]
            worst, model = max(errors, default=(NAN, "-")), any(e.other_model for e in runs)
            half = _small(median(error for error, _ in errors) if errors else NAN)
            yield (
                f"| {RULES[rule]} | {name}{' (other model)' if model else ''} | {len(runs)} | "
                f"{sum(e.verified for e in runs)} | {_ratios(entries, runs)} | {half} | "
                f"{_small(worst[0])} ({worst[1]}) |"
            )


def _ratios(entries: Sequence[Entry], runs: Sequence[Entry]) -> str:
    """Times against those of standard: median, least and greatest."""
    times = {(e.structure, e.flow_rule): e.time for e in entries if e.rung == STANDARD}
    ratios = [e.time / times.get((e.structure, e.flow_rule), NAN) for e in runs]
    ratios = [ratio for ratio in ratios if not math.isnan(ratio)]
    if not ratios:
        return "-"
    return f"{median(ratios):.2f}" + (f" ({min(ratios):.2f} to {max(ratios):.2f})" if len(ratios) > 1 else "")


def _of(entries: Sequence[Entry], rule: str, rung: str) -> list[Entry]:
    return [e for e in entries if e.flow_rule == rule and e.rung == rung]


def _table(entries: Sequence[Entry]) -> Iterator[str]:
    """The presets on every structure, a row each."""
    times = " | ".join(f"{name} [s]" for name in PRESETS)
    rest = "solver [s] | memory [MB] | error of draft | of standard | reference good to"
    yield f"| structure | load factor | {times} | {rest} |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for structure in STANDARD_SET:
        own = {e.rung: e for e in entries if e.structure == structure.name}
        if not own:
            continue
        draft, standard, reference = (own.get(f"accuracy: {name}") for name in PRESETS)
        against = next((e for e in own.values() if e.reference), None)
        best = " ".join(f"({e.rung})" for e in [against] if e is not None and e is not reference)
        factor = "-" if against is None else f"{against.load_factor:.6g}"
        yield (
            f"| {structure.name} | {factor}{' ' if best else ''}{best} | "
            f"{' | '.join(_time(each) for each in (draft, standard, reference))} | "
            f"{_seconds(NAN if standard is None else standard.solver_time)} | "
            f"{'-' if standard is None or math.isnan(standard.memory) else f'{standard.memory:.1f}'} | "
            f"{_error(draft)} | {_error(standard)} | {_small(NAN if reference is None else _reached(reference))} |"
        )


def _time(entry: Entry | None) -> str:
    """Seconds; a word where the run is not verified or gave nothing."""
    if entry is None or math.isnan(entry.time):
        return "-" if entry is None else "stopped" if "stopped" in entry.end else entry.end
    return _seconds(entry.time) + ("" if entry.verified else f" ({entry.status.replace('_', ' ')})")


def _error(entry: Entry | None) -> str:
    if entry is None or entry.reference or math.isnan(entry.distance):
        return "-"
    return f"<{_small(entry.resolution)}" if entry.distance < entry.resolution else _small(entry.distance)


def _failures(entries: Sequence[Entry]) -> Iterator[str]:
    """Every run that was stopped, failed, or is not verified, those of one structure and reason together."""
    found: dict[tuple[str, str, str], list[str]] = {}
    for e in entries:
        if not e.status or not e.verified:
            why = e.status.replace("_", " ") if e.status else e.end
            found.setdefault((e.structure, e.flow_rule, why), []).append(e.rung)
    for (structure, rule, why), rungs in found.items():
        yield f"- {structure}, {RULES[rule]}: {', '.join(rungs)}: {why}"
    yield "" if found else "Every run is verified.\n"


def _missing(entries: Sequence[Entry]) -> Iterator[str]:
    """Structures of the set that were not measured: their absence must not look like a result."""
    known = {(entry.structure, entry.flow_rule) for entry in entries}
    for rule in FLOW_RULES:
        missing = [s.name for s in STANDARD_SET if (s.name, rule) not in known]
        if missing:
            yield f"Not measured yet, {RULES[rule]}: {'; '.join(missing)}.\n"


def _origin(entries: Sequence[Entry]) -> Iterator[str]:
    """When and with what it was measured."""
    dates, machines = sorted(e.date[:10] for e in entries), sorted({e.machine for e in entries})
    when = dates[0] if dates[0] == dates[-1] else f"{dates[0]} to {dates[-1]}"
    yield f"Measured {when} on {'; '.join(machines)}, with {'; '.join(sorted({e.versions for e in entries}))}."


def _seconds(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.3g}"


def _small(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.1e}"
