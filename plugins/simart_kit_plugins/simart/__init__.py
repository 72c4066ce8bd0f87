"""The paper's method: a sparse 3D VQ-VAE, voxel tokens, and a language model that reads and writes them."""
