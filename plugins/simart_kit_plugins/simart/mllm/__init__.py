"""The language model: tokenizer, sizes, weights, and files that belong together."""
