"""What a picture shows on the blocks: loads, contact forces, joints that move, ties and fill, each a file."""
