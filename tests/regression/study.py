#!/usr/bin/env python3
"""Run a study of contrib/ on its smallest size: study.py STUDY.

The study runs by the Python that its first line names, which has the packages it needs."""

import os
import sys

os.execve(sys.argv[1], [sys.argv[1], "--quick"], {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
