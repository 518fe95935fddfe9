"""How each kind of joint turns, as formulas on arrays."""
