"""Does it move, and where is it overconstrained?"""
