"""Commands on how a drive turns: its angles, phasing, errors and freedom."""
