"""The kinematic spec: what a person or a model states of what moves, and how far a run keeps to it."""
