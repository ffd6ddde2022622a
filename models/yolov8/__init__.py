"""YOLOv8 in plain PyTorch, to train, measure and export a detector for this package's `detect` stage.

Written from the published description of the architecture: C2f blocks and SPPF, a path-aggregation neck, a
decoupled head without anchors whose box sides are distributions (DFL), task-aligned assignment. Runs on torch
1.13 (Debian 12) and newer, on a CPU or CUDA.
"""
