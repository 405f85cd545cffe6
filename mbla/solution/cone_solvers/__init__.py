"""Who solves cone and linear programs: the interior-point method of this package, clarabel, HiGHS, and the choice."""
