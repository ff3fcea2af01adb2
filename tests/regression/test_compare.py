#!/usr/bin/env python3
"""The comparison of summaries finds what it should and no more."""

import copy
import math
import unittest

import compare

SUMMARY = {
    "program": {"version": "0.1.0", "ranks": 1},
    "mesh": {"bodies": 2, "cells": 16, "subdomains": 4},
    "state": {
        "energy": -1.25, "contact_force": [1e-18, 0., 100.],
        "active_contacts": 9, "f_mults": 40,
        "certificate": {"equilibrium": 1e-10, "penetration": 0.},
    },
    "optimization": {"design": [0.1, -0.2], "iterations": 3,
                     "stop_reason": "objective"},
    "times": {"total": 3.2},
}


class Compare(unittest.TestCase):
    def setUp(self):
        self.summary = copy.deepcopy(SUMMARY)
        self.reference = compare.accepted(SUMMARY, {})

    def messages(self, ranks=1):
        return compare.compare(self.summary, self.reference, ranks)

    def expect_one(self, start, ranks=1):
        messages = self.messages(ranks)
        self.assertEqual(len(messages), 1, messages)
        self.assertTrue(messages[0].startswith(start), messages)

    def test_a_summary_agrees_with_itself(self):
        self.assertEqual(self.messages(), [])

    def test_decomposition_and_times_are_not_compared(self):
        self.summary["mesh"]["subdomains"] = 8
        self.summary["times"]["total"] = 99.
        self.assertEqual(self.messages(), [])

    def test_the_tolerance_is_relative(self):
        self.summary["state"]["energy"] *= 1 + 0.9e-6
        self.assertEqual(self.messages(), [])
        self.summary["state"]["energy"] = -1.25 * (1 + 1.1e-6)
        self.expect_one("state.energy: ")

    def test_vectors_are_compared_in_the_maximum_norm(self):
        self.summary["state"]["contact_force"][0] = 0.9e-4
        self.assertEqual(self.messages(), [])
        self.summary["state"]["contact_force"][0] = 1.1e-4
        self.expect_one("state.contact_force: ")

    def test_an_own_tolerance_is_used_and_kept(self):
        self.reference["tolerances"] = {"optimization.design": 1e-3}
        self.summary["optimization"]["design"][0] += 1e-4
        self.assertEqual(self.messages(), [])
        kept = compare.accepted(self.summary, self.reference)
        self.assertEqual(kept["tolerances"], self.reference["tolerances"])

    def test_nan_missing_length_and_words_fail(self):
        for wrong in (math.nan, None, [1.], "x", True):
            self.summary["state"]["energy"] = wrong
            self.expect_one("state.energy: ")
        del self.summary["state"]["energy"]
        self.expect_one("state.energy: ")

    def test_nan_in_a_vector_fails(self):
        self.summary["optimization"]["design"][1] = math.nan
        self.expect_one("optimization.design: ")

    def test_a_changed_word_fails(self):
        self.summary["optimization"]["stop_reason"] = "evaluations"
        self.expect_one("optimization.stop_reason: ")

    def test_iterations_may_differ_by_a_tenth(self):
        self.summary["state"]["f_mults"] = 44
        self.assertEqual(self.messages(), [])
        self.summary["state"]["f_mults"] = 45
        self.expect_one("state.f_mults: ")

    def test_small_counts_may_differ_by_one(self):
        self.summary["optimization"]["iterations"] = 4
        self.assertEqual(self.messages(), [])

    def test_iterations_are_compared_on_all_ranks(self):
        self.summary["program"]["ranks"] = 3
        self.assertEqual(self.messages(ranks=3), [])
        self.summary["state"]["f_mults"] = 400
        self.expect_one("state.f_mults: ", ranks=3)

    def test_a_run_on_another_number_of_ranks_fails(self):
        self.expect_one("program.ranks: ", ranks=3)

    def test_a_bad_or_missing_certificate_fails(self):
        self.summary["state"]["certificate"]["penetration"] = math.nan
        self.expect_one("state.certificate.penetration: ")
        self.summary["state"]["certificate"]["penetration"] = 2e-6
        self.expect_one("state.certificate.penetration: ")
        del self.summary["state"]["certificate"]
        self.expect_one("state.certificate: ")

    def test_an_empty_reference_fails(self):
        self.reference = {}
        self.expect_one("values: ")


if __name__ == "__main__":
    unittest.main()
