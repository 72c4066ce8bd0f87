"""The paper's two tables about the sparse VQ-VAE: what each of its configurations costs and gives."""
