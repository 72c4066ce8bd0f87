"""What the model is asked: system prompt, question, picture and voxel tokens as one sequence."""
