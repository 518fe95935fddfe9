"""Motions that repeat, and whether they last."""
