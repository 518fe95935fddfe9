"""Where does the power go?"""
