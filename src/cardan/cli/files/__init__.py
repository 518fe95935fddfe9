"""Commands on files, data, formulas, the report and the app."""
