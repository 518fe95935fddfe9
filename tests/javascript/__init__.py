"""What checks the scripts of the app: types, lint, tests without a browser."""
