"""Broken geometry files: each gets a named diagnosis, or the result of the file that is not broken.

``stones``    blocks by corners and faces, and the arch that every mutant is made from
``formats``   how they are written: OBJ, STL, PLY, VTU, Gmsh, CalculiX, COMPAS, DXF, tables
``shapes``    what is done to the stones: holes, turned faces, doubled corners, coordinates of 1e308
``texts``     what is done to a file once it is written: cut off, lines missing, words where numbers belong
``mutants``   all of them, from a seed
``judging``   what a run of the command line makes of one, and whether that is right
"""
