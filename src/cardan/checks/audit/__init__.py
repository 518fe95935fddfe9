"""Whether answers about one drive that speak of the same quantity agree: pairs of them, one verdict."""
