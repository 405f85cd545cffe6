"""The load factor as a structure moves, and the reaction of a support that gives way, over finite displacements."""
