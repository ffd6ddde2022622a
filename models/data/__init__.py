"""Random worlds to learn from."""
