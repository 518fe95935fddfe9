"""What do tolerances and errors do to the motion?"""
