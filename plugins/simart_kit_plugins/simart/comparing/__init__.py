"""The ablation of the language model: forms of voxel sequences, trained and judged alike."""
