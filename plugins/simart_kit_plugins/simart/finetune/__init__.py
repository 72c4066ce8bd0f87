"""Fine-tuning of the language model on instruction data."""
