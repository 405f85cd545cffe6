"""Small disks, kills, signals, limits: what a command leaves then, and what it says."""
