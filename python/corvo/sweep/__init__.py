# SPDX-License-Identifier: MIT
"""Runs over many sequences, options and perturbations: `pip install corvo[sweep]`."""
