"""Rows about searches, limits and derivatives, and scenes of the repository."""

from cases import Figure
from gallery_runs import ROOT
from outcomes import METHODS, ONE, Refused, Row, Solved
from rollers import cylinders, rollers, spheres
from round_bodies import PINS, RINGS, SHELLS
from scenes import blocks, force
from small_scenes import two_bars
ROWS = []
