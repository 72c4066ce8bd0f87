"""The small model that is shipped: blocks of voxels to codes and back, occupied blocks only."""
