"""Geometry of turning: Möbius maps, frames, loops, screws."""
