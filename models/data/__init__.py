"""Random worlds to learn from; docs/dataset.md tells what is in them."""
