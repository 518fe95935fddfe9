"""What does every part carry?"""
