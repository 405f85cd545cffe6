"""``mbla verify``: all that a result file claims, found again from what is in it."""
