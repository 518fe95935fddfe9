"""Simple bodies by their sizes: yokes, crosses, rings and bearings, for joints and shafts alike."""
