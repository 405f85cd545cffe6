"""Where a function of one variable is zero, in few evaluations."""
