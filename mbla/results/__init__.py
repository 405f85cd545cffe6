"""Results: HDF5, VTU and PVD for ParaView, listing, JSON and pictures, written together or not at all."""
