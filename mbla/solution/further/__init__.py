"""Results besides the load factor, each from its own record, and none of which changes that."""
