"""A long sweep in one process loses nothing, repeats nothing and does not grow."""
