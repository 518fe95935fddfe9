"""What is said: quantities, sentences, tables and whole answers as data, told to a reader by a renderer, once."""
