"""The torsional model: from a drive to its equations and natural modes."""
