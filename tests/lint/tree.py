"""A small project on which the checks of lint.py are tried."""

import pathlib
import stat
import tempfile
import unittest

TABLE = """
| module | holds | may include |
|---|---|---|
| `base` | errors | nothing |
| `mesh` | meshes | `base` |
| `feti` | solver | `base` |
| `io` | files | all |

| label | what | where |
|---|---|---|
| `unit` | another table | `tests` |
"""


class Tree(unittest.TestCase):
    """A temporary project; write() adds a file to it."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name).resolve()
        self.write("doc/architecture.md", TABLE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def write_program(self, script):
        path = self.write("snug", "#!/bin/sh\n" + script)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def expect(self, messages, *starts):
        messages = list(messages)
        self.assertEqual(len(messages), len(starts), messages)
        for message, start in zip(messages, starts):
            self.assertTrue(message.startswith(start), message)
