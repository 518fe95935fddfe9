"""How does the drive vibrate in torsion over time?"""
