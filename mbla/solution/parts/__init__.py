"""The parts of a structure, whose blocks can interact, one by one, and the whole structure from them."""
