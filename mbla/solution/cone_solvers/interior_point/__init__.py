"""The primal-dual interior-point method on a condensed system."""
