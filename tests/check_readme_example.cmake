# SPDX-License-Identifier: MIT
# Fails unless README.md shows EXAMPLE word for word, but for its license line.
#   cmake -D README=... -D EXAMPLE=... -P check_readme_example.cmake
file(READ "${README}" readme)
file(READ "${EXAMPLE}" example)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" example "${example}")
string(FIND "${readme}" "```cpp\n${example}```\n" position)
if(position EQUAL -1)
  message(FATAL_ERROR "${README} does not show the text of ${EXAMPLE}")
endif()
