"""What the commands share: options, where a drive comes from, how an answer is told, and what goes wrong."""
