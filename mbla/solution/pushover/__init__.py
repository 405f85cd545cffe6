"""The load factor as a structure moves, and the reaction of a settling support, over finite displacements."""
