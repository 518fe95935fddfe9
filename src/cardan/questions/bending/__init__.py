"""At which speeds does the drive whirl, and how does it run there?"""
