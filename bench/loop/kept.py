"""Answers that took long, kept in a file as they come, so that a script that was stopped goes on from them."""
import json


class Kept(dict):
    """Answers by name, as the file has them; `file` None: in memory alone."""

    def __init__(self, file):
        super().__init__(json.loads(file.read_text()) if file and file.exists() else {})
        self.file = file

    def keep(self, name, answer):
        """Adds an answer and writes the file anew, whole or not at all."""
        self[name] = answer
        if self.file:
            beside = self.file.with_suffix(".part")
            beside.write_text(json.dumps(self, indent=1) + "\n")
            beside.replace(self.file)
