"""Keys of the drive file in words, by the name they had here."""

from cardan.drive.fields.words import in_words, with_key

__all__ = ["in_words", "with_key"]
