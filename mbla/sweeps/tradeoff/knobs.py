"""Settings that the user names on the command line.

``--knob analysis.tolerance=1e-6,1e-8`` is one setting for each value; several knobs make every combination of theirs.
``--setting 'NAME: analysis.accuracy=draft analysis.solver=clarabel'`` is one setting under a name of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from mbla.errors import UsageError
from mbla.sweeps.measure.setting import Setting
from mbla.sweeps.tradeoff.rung import Rung

MOST = 200
"""settings in one study"""
BRACKETS = {"[": 1, "{": 1, "]": -1, "}": -1}


def asked_rungs(knobs: Sequence[str], settings: Sequence[str]) -> list[Rung]:
    """Rungs of the two options, none if neither is given; UsageError for a text that is none."""
    choices = [_values(text) for text in knobs]
    count = len(settings)
    size = 1
    for choice in choices:
        size *= len(choice)
    if (count := count + (size if knobs else 0)) > MOST:
        raise UsageError("tradeoff-option", f"--knob: {count} settings, more than {MOST}; name fewer values")
    rungs = [_combination(values) for values in product(*choices)] if knobs else []
    return rungs + [_named(text) for text in settings]


def _values(text: str) -> list[str]:
    """``key=value`` for each value; commas inside of brackets do not part them."""
    key, equals, listed = text.partition("=")
    parts, depth = [""], 0
    for letter in listed:
        depth += BRACKETS.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    values = [part.strip() for part in parts]
    if not equals or not key.strip() or not all(values):
        raise UsageError("tradeoff-option", f"--knob {text}: must be KEY.PATH=VALUE,VALUE,...")
    return [f"{key.strip()}={value}" for value in values]


def _combination(overrides: Sequence[str]) -> Rung:
    shown = [text.removeprefix("analysis.").replace("=", ": ", 1) for text in overrides]
    return Rung(", ".join(shown), Setting(tuple(overrides)))


def _named(text: str) -> Rung:
    name, colon, rest = text.partition(":")
    overrides = rest.split()
    if not colon or not name.strip() or not overrides or not all("=" in override for override in overrides):
        raise UsageError(
            "tradeoff-option",
            f"--setting {text}: must be 'NAME: KEY.PATH=VALUE KEY.PATH=VALUE ...', values without spaces",
        )
    return Rung(" ".join(name.split()), Setting(tuple(overrides)))
