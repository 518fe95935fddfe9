"""How does the drive vibrate in torsion as it runs steadily?"""
