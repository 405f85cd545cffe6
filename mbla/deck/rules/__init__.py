"""Checks across the keys of one section, each registered for its type; names across sections are in ``references``.

A rule gets a section whose own keys are all valid and yields (key path below it, what is wrong and what is allowed).
One file per section of the deck.
"""

from mbla.deck.rules import analysis as analysis
from mbla.deck.rules import arches as arches
from mbla.deck.rules import bridges as bridges
from mbla.deck.rules import columns as columns
from mbla.deck.rules import contacts as contacts
from mbla.deck.rules import expectations as expectations
from mbla.deck.rules import items as items
from mbla.deck.rules import joints as joints
from mbla.deck.rules import loads as loads
from mbla.deck.rules import masonry as masonry
from mbla.deck.rules import plans as plans
from mbla.deck.rules import selectors as selectors
from mbla.deck.rules import supports as supports
from mbla.deck.rules import vaults as vaults
from mbla.deck.rules.exactly_one import AT_LEAST_ONE as AT_LEAST_ONE
from mbla.deck.rules.exactly_one import EXACTLY_ONE as EXACTLY_ONE
