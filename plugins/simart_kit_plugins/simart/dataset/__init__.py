"""Instruction data: articulated objects in many states, as questions and answers."""
