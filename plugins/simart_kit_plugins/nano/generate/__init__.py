"""Made-up articulated objects: a data set for training, and a benchmark, that anybody may use."""
