"""The settings under which a deck is run: presets, tolerances, solvers, schemes, other models; or what a user
names.

``--knob analysis.tolerance=1e-6,1e-8`` is one setting for each value; several knobs make every combination of theirs.
``--setting 'NAME: analysis.accuracy=draft analysis.solver=clarabel'`` is one setting under a name of its own.

Settings that solve the same model differ by an error; another flow rule or contact model, and anything outside of the
analysis section, is another model, whose difference is no error.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import prod

from mbla.deck import Deck, read_deck
from mbla.deck.content import DeckContent
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.errors import DeckError, UsageError
from mbla.sweeps.identity import effective_tree
from mbla.sweeps.plan import Plain, override_texts
from mbla.sweeps.tables.sweep_table import as_text

REFERENCE = "accuracy: reference"
"""name of the setting that the others are compared with"""
KNOWN: tuple[tuple[str, Mapping[str, Plain]], ...] = (
    ("the deck's own settings", {}),
    *((f"tolerance: {value}", {"analysis.tolerance": float(value)}) for value in ("1e-4", "1e-6", "1e-8", "1e-10")),
    *((f"solver: {name}", {"analysis.solver": name}) for name in ("mbla", "clarabel")),
    ("scheme: published", {"analysis.scheme": "published"}),
    *((f"points per edge: {number}", {"contacts.points.per_edge": number}) for number in (2, 3)),
    ("contact_model: convex", {"analysis.contact_model": "convex"}),
    ("flow_rule: associative", {"analysis.flow_rule": "associative"}),
)
"""settings after the presets"""
LIMITS = ("max_iterations", "time_limit")
"""knobs without a default that are limits of effort, none of accuracy"""
NO_MODEL = {"analysis", "output", "expected", "title"}
MOST = 200
"""settings in one study"""


@dataclass(frozen=True)
class Setting:
    """A setting under a name.

    name     : as a deck says it, ``accuracy: draft``
    settings : values by key path of the deck
    without  : knobs of the analysis section that the deck gives and this setting leaves to ``accuracy``
    unfit    : why it does not apply to this deck; empty where it does
    model    : what makes it another model than the deck's, in words; empty where it is the deck's
    """

    name: str
    settings: Mapping[str, Plain] = field(default_factory=dict)
    without: tuple[str, ...] = ()
    unfit: str = ""
    model: str = ""


def settings_of(deck: Deck, fixed: Sequence[str], named: Sequence[Setting]) -> list[Setting]:
    """The reference and what the user names, or every setting that mbla knows of; those that do not apply say why.

    fixed : overrides with which the deck was read

    Raises UsageError where two have one name, and where nothing that was named applies.
    """
    settings = [_preset(deck, fixed, "reference"), *(setting for setting in named if setting.name != REFERENCE)]
    if not named:  # the reference early, so that a time limit that ends the study leaves something to compare
        settings = [_preset(deck, fixed, "standard"), *settings, _preset(deck, fixed, "draft")]
        settings += [Setting(name, values) for name, values in KNOWN]
    names = [setting.name for setting in settings]
    if twice := [name for name in names if names.count(name) > 1]:
        raise UsageError("tradeoff-option", f"{twice[0]}: two settings of that name")
    seen: dict[str, str] = {}
    fitted = [_fitted(deck, fixed, setting, seen) for setting in settings]
    if len(fitted) > 1 and all(setting.unfit for setting in fitted[1:]):
        why = "; ".join(f"{setting.name}: {setting.unfit}" for setting in fitted[1:])
        raise UsageError("tradeoff-option", f"no setting that was asked for applies to the deck: {why}")
    return fitted


def _preset(deck: Deck, fixed: Sequence[str], word: str) -> Setting:
    """One word, free of the knobs that the deck sets by itself."""
    without = given_knobs(deck, fixed)
    if not without:
        return Setting(f"accuracy: {word}", {"analysis.accuracy": word})
    section = effective_tree(deck.path, fixed).data["analysis"]
    kept: dict[str, Plain] = {key: value for key, value in section.items() if key not in without}
    return Setting(f"accuracy: {word}", {"analysis": kept | {"accuracy": word}}, without)


def given_knobs(deck: Deck, fixed: Sequence[str]) -> tuple[str, ...]:
    """Knobs that ``accuracy`` sets and the deck gives by itself; not those of ``fixed``, which the user wants so."""
    chosen = {text.partition("=")[0].strip().removeprefix("analysis.") for text in fixed}
    return tuple(
        name
        for name, key in AnalysisSection.model_fields.items()
        if key.default is None and name not in LIMITS and name not in chosen
        if getattr(deck.analysis, name) is not None
    )


def _fitted(deck: Deck, fixed: Sequence[str], setting: Setting, seen: dict[str, str]) -> Setting:
    """The setting with what is wrong with it on this deck: refused, the same as an earlier one, another model."""
    try:
        content = read_deck(deck.path, (*fixed, *override_texts(setting.settings))).content
    except DeckError as error:
        return replace(setting, unfit="; ".join(fault.message for fault in error.faults))
    same = seen.setdefault(content.model_dump_json(exclude={"output", "expected"}), setting.name)
    unfit = "" if same == setting.name else f"the same as {same}"
    return replace(setting, unfit=unfit, model=other_model(deck.content, content))


def other_model(deck: DeckContent, changed: DeckContent) -> str:
    """What makes it another model, as ``flow_rule, contacts``; empty where it is the same."""
    keys = [
        key for key in ("flow_rule", "contact_model") if getattr(deck.analysis, key) != getattr(changed.analysis, key)
    ]
    own, its = (content.model_dump(mode="json", exclude=NO_MODEL) for content in (deck, changed))
    return ", ".join([*keys, *(key for key in own if own[key] != its.get(key))])


# --- settings of the command line -------------------------------------------------------------------------------------


def named_settings(knobs: Sequence[str], settings: Sequence[str]) -> list[Setting]:
    """Settings of the two options, none if neither is given; raises UsageError for an invalid text."""
    choices = [_choice(text) for text in knobs]
    count = len(settings) + (prod(map(len, choices)) if knobs else 0)
    if count > MOST:
        raise UsageError("tradeoff-option", f"--knob: {count} settings, more than {MOST}; name fewer values")
    return [*(_combination(chosen) for chosen in product(*choices) if chosen), *map(_named, settings)]


def _choice(text: str) -> list[tuple[str, Plain]]:
    """Key path and value for each value, as YAML has it."""
    key, _, listed = text.partition("=")
    document = read_yaml(SourceText("--knob", f"values: [{listed}]", line=1), 0)
    values: list[Plain] = [] if document.faults else document.data["values"]
    if not key.strip() or not values or None in values:
        raise UsageError("tradeoff-option", f"--knob {text}: must be KEY.PATH=VALUE,VALUE,...")
    return [(key.strip(), value) for value in values]


def _combination(chosen: Sequence[tuple[str, Plain]]) -> Setting:
    shown = [f"{key.removeprefix('analysis.')}: {as_text(value)}" for key, value in chosen]
    return Setting(", ".join(shown).replace("e-0", "e-"), dict(chosen))  # 1e-6, as people write it


def _named(text: str) -> Setting:
    name, _, rest = text.partition(":")
    texts = rest.split()
    if not name.strip() or not texts or not all("=" in each for each in texts):
        words = f"--setting {text}: must be 'NAME: KEY.PATH=VALUE KEY.PATH=VALUE ...', values without spaces"
        raise UsageError("tradeoff-option", words)
    return Setting(" ".join(name.split()), dict(_choice(each)[0] for each in texts))
