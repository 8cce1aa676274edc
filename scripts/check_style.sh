#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks what the compiler does not: format, license lines, the direction of includes, spelling.
# Prints what is wrong and fails.
#
#   check_style.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

failed=0
fail() {
  echo "$1" >&2
  failed=1
}

find orb vo apps python bench tests examples -name '*.h' -o -name '*.cpp' | sort |
  xargs clang-format-14 --dry-run -Werror || failed=1

folders=(orb vo apps python bench tests examples cmake scripts)
while read -r file; do
  head -n 2 "$file" | grep -q 'SPDX-License-Identifier: MIT$' ||
    fail "$file: the first two lines lack \"SPDX-License-Identifier: MIT\""
done < <(find CMakeLists.txt pyproject.toml .ci/run "${folders[@]}" -type f -regex \
  '.*\(\.\(h\|cpp\|cmake\|sh\|py\|toml\)\|CMakeLists\.txt\|\.ci/run\)' | sort)

# A file may include headers of its own layer and of those below.
layer_of() {
  case $1 in
    orb/*) echo 0 ;;
    vo/core/* | vo/lie/* | vo/math/*) echo 1 ;;
    vo/camera/* | vo/geometry/*) echo 2 ;;
    vo/map/*) echo 3 ;;
    vo/optimization/*) echo 4 ;;
    vo/mapping/* | vo/tracking/*) echo 5 ;;
    vo/odometry*) echo 6 ;;
    vo/offline/*) echo 7 ;;
    vo/io/* | vo/evaluation/*) echo 7 ;;
    apps/*) echo 8 ;;
    python/*) echo 9 ;;
  esac
}
while IFS=: read -r file include; do
  header=$(sed -E 's/.*"(.*)".*/\1/' <<<"$include")
  [ "$(layer_of "$header")" -le "$(layer_of "$file")" ] || fail "$file includes $header, which is above it"
done < <(grep -rE --include='*.h' --include='*.cpp' '^#include "(orb|vo|apps|python)/' orb vo apps python)

# What the command needs of an operating system is in one folder.
while read -r file; do
  fail "$file includes a header of an operating system; such code belongs in apps/system"
done < <(grep -rlE '^#include <(dirent|dlfcn|fcntl|ftw|poll|spawn|unistd|sys/[a-z]+)\.h>' orb vo apps python/src examples |
  grep -v '^apps/system/' || true)

codespell || failed=1
exit "$failed"
