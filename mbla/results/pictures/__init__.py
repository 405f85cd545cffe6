"""Pictures without ParaView."""
