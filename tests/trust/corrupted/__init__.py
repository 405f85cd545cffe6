"""Result files that were damaged, edited and forged, given to every command that reads one.

- damaged, or malformed through HDF5: every command must refuse them, or say what it says of the file as it was written;
- other figures: ``mbla verify`` must not agree unless all that it says is what it says of the file as it
  was written, the history of the run aside, which proves nothing. No command may crash on them.
"""
