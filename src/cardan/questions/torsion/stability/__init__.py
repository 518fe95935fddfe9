"""Where is steady running unstable?"""
