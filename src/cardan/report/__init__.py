"""The report: one page for one drive, that needs no network and prints well."""
