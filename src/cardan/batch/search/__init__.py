"""Points that are searched for: the best, the boundary of a limit, what an answer owes its spread to."""
