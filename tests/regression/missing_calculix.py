#!/usr/bin/env python3
"""Tests that need CalculiX are skipped where Debian 13 lacks it, and fail on other systems."""

import contextlib
import io
import pathlib
import sys
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib" / "lib"))

import calculix  # noqa: E402


def end_of(program, **system):
    """Return the exit status of require_ccx(), None if it returns, and what it prints on a system
    where the path of ccx is @p program."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), mock.patch("shutil.which", return_value=program), \
            mock.patch("platform.freedesktop_os_release", return_value=system):
        try:
            return calculix.require_ccx(), said.getvalue()
        except SystemExit as end:
            return end.code, said.getvalue()


class MissingCalculix(unittest.TestCase):
    def test_debian_13_skips(self):
        status, said = end_of(None, ID="debian", VERSION_ID="13")
        self.assertEqual(status, calculix.SKIPPED)
        self.assertTrue(said.startswith("skipped: "), said)

    def test_other_systems_fail(self):
        for system in ({"ID": "debian", "VERSION_ID": "12"}, {"ID": "debian"},
                       {"ID": "other", "VERSION_ID": "13"}):
            self.assertIn("is missing", end_of(None, **system)[0])

    def test_ccx_is_used_where_it_is(self):
        for version in ("12", "13"):
            self.assertEqual(end_of("/usr/bin/ccx", ID="debian", VERSION_ID=version), (None, ""))


if __name__ == "__main__":
    unittest.main()
