"""How long do the bearings last?"""
