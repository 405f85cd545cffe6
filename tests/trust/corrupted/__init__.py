"""Result files that were damaged, malformed and forged, given to every command that reads one."""
