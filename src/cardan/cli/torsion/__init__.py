"""Commands on torsional vibration."""
