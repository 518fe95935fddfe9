"""Spreadsheets: books, and in them charts as the program that opens them draws its own, each beside its numbers."""
