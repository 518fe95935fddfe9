"""What one user works on: the drive as text and as a model, its history, the user's choices. No browser in here."""
