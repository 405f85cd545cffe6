"""What the deck stage remarks, and expectations that are not met."""

from __future__ import annotations

from mbla.deck.notices import GRAVITY_TOLERANCE
from mbla.deck.units import STANDARD_GRAVITY
from mbla.results.explanations.explanation import Explanation

_UNUSED = "None: what nothing uses has no effect."
_REMOVE = "Leave it out, or use it where it was meant; a misspelt name elsewhere is the usual reason."

OF_DECK = (
    Explanation(
        "gravity-unusual",
        "warning",
        f"Gravity differs from {STANDARD_GRAVITY:g} m/s2 by more than {GRAVITY_TOLERANCE:.0%}.",
        "Dead load is wrong by the same factor. A load factor of an acceleration is in units of "
        f"{STANDARD_GRAVITY:g} m/s2 and unaffected only if live and dead load scale together; one of a force is wrong "
        "by the factor.",
        "Mostly a deck in mm, cm, ft or in whose gravity was written for metres; numbers of gravity are in the deck's "
        "unit of length per s2.",
        "Leave gravity out: the default is the standard one in the deck's units. Or write it with its unit.",
        example='gravity: [0, 0, "-9.81 m/s^2"]',
    ),
    Explanation(
        "key-idle",
        "warning",
        "A key of the deck has no effect with the other settings of this run.",
        "The figure is that of the settings in effect, which the listing prints; the idle key did not enter it.",
        "A setting of another flow rule, scheme or contact model; often --flow-rule or --set has switched it off.",
        "Nothing, if the key is meant for other runs of the deck. Else choose the flow rule, scheme or contact model "
        "that the message names.",
        example="analysis.published has no effect: it applies to flow_rule: non_associative with scheme: published",
    ),
    Explanation(
        "parameter-unused",
        "notice",
        "A parameter of the deck appears in no expression.",
        "None on the figure of this run, but changing the parameter with --set changes nothing.",
        'A number was written out where "=name" was meant, or the parameter is left over.',
        _REMOVE,
    ),
    Explanation(
        "material-unused",
        "notice",
        "No block is made of a material of the deck.",
        _UNUSED,
        "The material is left over, or blocks name another one.",
        _REMOVE,
    ),
    Explanation(
        "joint-unused",
        "notice",
        "No contact, support or override names a joint law of the deck.",
        f"{_UNUSED} Where the law was meant for some joints, these have another one: look at the table of joint laws.",
        "The law is left over, or its override is missing.",
        _REMOVE,
    ),
    Explanation(
        "load-unused",
        "notice",
        "No load case takes a named load of the deck.",
        f"{_UNUSED} A load that was meant to act does not.",
        "The load is left over, or a load case lacks its {loads: NAME}.",
        _REMOVE,
    ),
    Explanation(
        "not-as-expected",
        "warning",
        "A figure differs from the deck's expected section by more than its tolerance.",
        "The figure stands as verified or not by itself; that it is not what the deck's author expected makes the exit "
        "status 4.",
        "The deck was changed, --set or --flow-rule asks for something else, or the program computes another value "
        "than the source of the expectation.",
        "Compare with the source that the message gives; correct the deck, or the expectation and its source.",
        example="push_x: load_factor 0.6512, expected 0.643 within 0.001 (doi:...)",
    ),
)
