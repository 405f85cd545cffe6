"""Disks that fail, kills, signals, limits: what a command leaves then, and what it says.

``shim.c`` stands between a process and the C library, for Python and for libraries written in C alike; where there
is no compiler the checks that need it are skipped. Commands run in copies of one process that has everything imported.
"""
