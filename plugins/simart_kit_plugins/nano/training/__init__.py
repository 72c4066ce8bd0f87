"""How simart-nano is trained: a pool of made-up objects, steps over it, and what came of it."""
