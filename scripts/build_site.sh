#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the documentation site with MkDocs in build/site: the pages of docs/, the README and the API
# documentation. Warnings, such as links to pages or headings that do not exist, are errors.
#
#   build_site.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mkdocs=.venv/bin/mkdocs
[ -x "$mkdocs" ] || { echo "build_site.sh: run install_dependencies.sh --development first" >&2; exit 1; }

scripts/build_api_docs.sh
# The theme recommends another generator on every build.
NO_MKDOCS_2_WARNING=1 "$mkdocs" build --strict --site-dir build/site
if grep -rnE --include='*.html' '<(script|link|img|iframe)[^>]* (src|href)="(https?:)?//' build/site; then
  echo "build_site.sh: these pages load something from elsewhere" >&2
  exit 1
fi
echo "Documentation site: $PWD/build/site/index.html"
