"""Sparse 3D VQ-VAE: a grid of surface voxels to a few codes and back. Needs torch; import its modules."""
