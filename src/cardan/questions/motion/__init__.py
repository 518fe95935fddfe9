"""How does the drive turn?"""
