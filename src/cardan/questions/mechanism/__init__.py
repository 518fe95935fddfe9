"""What mechanism files answer beside mobility: how every link moves, and what drives it and its pairs carry."""
