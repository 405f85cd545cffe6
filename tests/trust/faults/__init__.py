"""Disks that fail, kills, signals, limits: what a command leaves then, and what it says.

``shim.c`` stands between a process and the C library; where there is no compiler the checks that need it are skipped.
"""
