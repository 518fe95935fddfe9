"""Torsional vibration: one folder a question, on one model."""
