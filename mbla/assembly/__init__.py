"""Assembly stage: what the solver sees of a model and its contacts, built once a deck, and the way back to blocks.

Glued blocks become rigid bodies (:mod:`~mbla.assembly.rigid_bodies`), a force that is sought gets a load cell
(:mod:`~mbla.assembly.load_cell`), ties become contact points (:mod:`~mbla.assembly.ties`). Motions and ties are taken
back to those of the deck by :mod:`~mbla.assembly.lift`.
"""

from mbla.assembly.assembly import Assembly, assembly_of
from mbla.assembly.build import build_assembly

__all__ = ["Assembly", "assembly_of", "build_assembly"]
