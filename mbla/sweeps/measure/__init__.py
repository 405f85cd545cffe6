"""Runs of one deck under other settings or loads, measured in processes of their own."""
