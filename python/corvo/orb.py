# SPDX-License-Identifier: MIT
"""The features by themselves: extraction, matching, and an index of descriptors."""

from corvo._corvo import Extractor, Features, LshIndex, match

__all__ = ["Extractor", "Features", "LshIndex", "match"]
