"""``mbla find``: the value of a parameter at which a result is what it should be."""
