"""Training of the sparse 3D VQ-VAE on folders of meshes. Needs torch; import its modules."""
