"""What the model says of an object: parts, how they move, what they are made of, and where they are."""
