"""The same deck gives the same bytes, wherever, whenever and under whatever settings of the machine it is run.

Bytes are compared with a clock that stands still: then every file must be the same to the last byte, also the HDF5
files. What differs with a clock that goes is not looked at, nor what a search finds that is told to end by the clock
(``ferris_wall_3_lowest``, ``ferris_wall_5_lowest``).
"""
