"""Answers that several tests read."""

# The example of the paper's appendix, its voxels without the dots.
PAPER = """{
  "object_captions": {
    "name": "Storage Box with Frame",
    "scale": 40.0
  },
  "parts_captions": {
    "0": {
      "type": "fixed",
      "material": "Plastic",
      "density": "1.2 g/cm^3",
      "Young's Modulus (GPa)": 2.5
    },
    "1": {
      "type": "revolute",
      "parent": "0",
      "center": [100, 138, 101],
      "axis": [100, 0, 0],
      "limits": [-54, 45]
    }
  },
  "parts_voxels": {
    "0": "<voxel> 0 1785 <voxel> 1 649",
    "1": "<voxel> 43 1930 <voxel> 44 13"
  }
}"""
