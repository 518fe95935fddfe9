"""How are the yokes set, and where do the joints stand?"""
