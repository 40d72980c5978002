"""Styles from examples: several clips of one skeleton make a new one."""
