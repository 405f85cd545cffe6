"""Files for ParaView: blocks, contact points, interfaces, the animation of the mechanism."""
