"""Keys that a deck gives and that its other keys leave without effect: each is said in a warning.

They are no faults: ``--flow-rule`` and ``--set`` leave keys unused that the deck has for another run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from mbla.deck.content import DeckContent
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.tree import KeyPath, Tree
from mbla.errors import Message, Notice

Applies = Callable[[AnalysisSection], bool]


def _concave(analysis: AnalysisSection) -> bool:
    return analysis.contact_model == "concave"


def _no_normality(analysis: AnalysisSection) -> bool:
    return analysis.flow_rule == "non_associative"


def _with_scheme(*schemes: str) -> Applies:
    return lambda analysis: _no_normality(analysis) and analysis.scheme in schemes


def _by_proximal_steps(analysis: AnalysisSection) -> bool:
    return analysis.flow_rule == "dilatancy" or _with_scheme("auto", "proximal", "lowest")(analysis)


def _in_the_interior(analysis: AnalysisSection) -> bool:
    return _concave(analysis) and _with_scheme("auto", "interior", "lowest")(analysis)


def _by_exact_law(analysis: AnalysisSection) -> bool:
    published = analysis.scheme == "published" and _no_normality(analysis)
    return analysis.flow_rule in ("non_associative", "dilatancy") and not published


APPLIES: Mapping[str, tuple[Applies, str]] = {
    "sides": (lambda analysis: analysis.friction_cone == "polyhedral", "friction_cone: polyhedral"),
    "scheme": (_no_normality, "flow_rule: non_associative"),
    "proximal": (_by_proximal_steps, "scheme: auto, proximal or lowest, and flow_rule: dilatancy"),
    "interior": (_in_the_interior, "scheme: auto, interior or lowest, and contact_model: concave"),
    "path": (_with_scheme("path"), "flow_rule: non_associative with scheme: path"),
    "lowest": (_with_scheme("lowest"), "flow_rule: non_associative with scheme: lowest"),
    "published": (_with_scheme("published"), "flow_rule: non_associative with scheme: published"),
    "gap": (
        lambda analysis: _concave(analysis) and analysis.friction_cone == "circular",
        "contact_model: concave with friction_cone: circular",
    ),
    "residual": (_by_exact_law, "flow_rule: non_associative or dilatancy with another scheme than published"),
    "peak": (
        lambda analysis: _concave(analysis) and _no_normality(analysis),
        "contact_model: concave with flow_rule: non_associative",
    ),
    "range": (
        lambda analysis: _concave(analysis) and analysis.flow_rule != "associative",
        "contact_model: concave and another flow_rule than associative",
    ),
    "reductions": (_concave, "contact_model: concave"),
}
"""Key of the analysis section -> whether it has an effect, and with what it has."""


def unused_keys(tree: Tree, content: DeckContent) -> Iterator[Notice]:
    """A warning for each key that is given without effect."""
    analysis = content.analysis
    given = tree.data.get("analysis") or {}
    for key, (applies, where) in APPLIES.items():
        if key in given and not applies(analysis):
            yield _notice(tree, ("analysis", key), where)
    for name, joint in content.joints.items():
        if joint.dilatancy > 0.0 and analysis.flow_rule != "dilatancy":
            yield _notice(tree, ("joints", name, "dilatancy"), "flow_rule: dilatancy")


def _notice(tree: Tree, path: KeyPath, where: str) -> Notice:
    return Notice(
        "warning", "key-idle", str(tree.fault(path, Message("key-idle", f"has no effect: it applies to {where}")))
    )
