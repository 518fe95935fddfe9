"""Mathematics without machine words: arrays in, arrays out."""
