#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the bill of materials of a built corvo, as SPDX 2.3 in JSON, to standard output: the
# packages whose libraries the command and its module of codecs ask for themselves (DT_NEEDED), and
# those that are compiled or linked into them. Versions and licenses are those of the installed Debian packages; what those need
# in turn is theirs to tell.
#
#   make_sbom.sh [COMMAND]          default: build/release/apps/corvo
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

command=${1:-build/release/apps/corvo}
[ -x "$command" ] || { echo "make_sbom.sh: $command: no such program" >&2; exit 1; }
for tool in dpkg-query readelf ldd; do
  command -v $tool >/dev/null || { echo "make_sbom.sh: needs $tool" >&2; exit 1; }
done

# Headers, and libraries of which Debian has static ones.
compiled=(libceres-dev libeigen3-dev libcli11-dev nlohmann-json3-dev)

version=$("$command" --version)
# Relative to the command, the module lies at the same place in the build tree and when installed.
modules=$(find "$(dirname "$(readlink -f "$command")")/.." -path "*/corvo/modules/corvo_codecs-$version.so")
[ -n "$modules" ] || { echo "make_sbom.sh: $command: its module of codecs is missing" >&2; exit 1; }
programs=("$command" "$(head -n 1 <<<"$modules")")

resolved=$(ldd "${programs[@]}")

# The package of a library, which /lib may hold as a link to /usr/lib.
package_of() {
  local path
  case $1 in ld-linux*) echo libc6; return ;; esac  # ldd does not resolve the loader.
  path=$(awk -v name="$1" '$1 == name { print $3; exit }' <<<"$resolved")
  dpkg-query --search "$path" "/usr$path" "$(readlink -f "$path")" 2>/dev/null |
    head -n 1 | sed 's/: .*//; s/:.*//; s/,.*//'
}

# The license of most files of a package as an SPDX expression, or NOASSERTION where it is neither
# known here nor told to machines by the package.
license_of() {
  case $1 in
    libc6) echo LGPL-2.1-or-later; return ;;
    libstdc++6 | libgcc-s1) echo GPL-3.0-or-later_WITH_GCC-exception-3.1; return ;;
    libfmt* | libyaml-cpp*) echo MIT; return ;;
    libatlas*) echo BSD-3-Clause; return ;;
  esac
  local expression
  expression=$(awk '/^Files:[ \t]*\*/ { found = 1 }
    found && /^License:/ { sub(/^License:[ \t]*/, ""); print; exit }' \
    "/usr/share/doc/$1/copyright" 2>/dev/null | sed -E 's/\b(Expat|MIT\/X11)\b/MIT/g
      s/\b(Apache|MPL)-2(\.0)?\b/\1-2.0/g; s/\bBSD-([23])-[Cc]lause\b/BSD-\1-Clause/g
      s/\b(L?GPL)-([0-9])(\.0)?\+/\1-\2.0-or-later/g; s/\b(L?GPL)-2\.1\+/\1-2.1-or-later/g
      s/ and / AND /g; s/ or / OR /g')
  local known='(MIT|BSD-[23]-Clause|Apache-2\.0|MPL-2\.0|L?GPL-[0-9]\.[0-9]-or-later)'
  [[ $expression =~ ^$known(\ (AND|OR)\ $known)*$ ]] || expression=NOASSERTION
  echo "${expression// /_}"
}

list_packages() {
  local library
  readelf --dynamic --wide "${programs[@]}" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | sort -u |
    while read -r library; do printf '%s DYNAMIC_LINK %s\n' "$(package_of "$library")" "$library"; done
  for package in "${compiled[@]}"; do printf '%s STATIC_LINK -\n' "$package"; done
}

created=$(date --utc ${SOURCE_DATE_EPOCH:+--date=@$SOURCE_DATE_EPOCH} +%Y-%m-%dT%H:%M:%SZ)

list_packages | while read -r package relation library; do
  installed=$(dpkg-query --show --showformat='${Version}' "$package" 2>/dev/null || echo unknown)
  echo "$package $relation $library $installed $(license_of "$package")"
done | awk -v version="$version" -v created="$created" '
  BEGIN {
    printf "{\n \"spdxVersion\": \"SPDX-2.3\",\n \"dataLicense\": \"CC0-1.0\",\n"
    printf " \"SPDXID\": \"SPDXRef-DOCUMENT\",\n \"name\": \"corvo %s\",\n", version
    printf " \"documentNamespace\": \"urn:corvo:%s:%s\",\n", version, created
    printf " \"creationInfo\": {\"created\": \"%s\", \"creators\": [\"Tool: make_sbom.sh\"]},\n", created
    printf " \"packages\": [\n  {\"SPDXID\": \"SPDXRef-corvo\", \"name\": \"corvo\", \"versionInfo\": \"%s\",", version
    printf " \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseDeclared\": \"MIT\"}"
    relations = "  {\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"SPDXRef-corvo\"}"
  }
  {
    id = "SPDXRef-" $1
    gsub(/[^A-Za-z0-9.-]/, "-", id)
    comment = $3 == "-" ? "compiled in" : $3
    if (!(id in seen)) {
      order[++count] = id
      gsub("_", " ", $5)
      name[id] = $1; installed[id] = $4; license[id] = $5; files[id] = comment; relation[id] = $2
    } else {
      files[id] = files[id] ", " comment
    }
    seen[id] = 1
  }
  END {
    for (i = 1; i <= count; ++i) {
      id = order[i]
      printf ",\n  {\"SPDXID\": \"%s\", \"name\": \"%s\", \"versionInfo\": \"%s\",", id, name[id], installed[id]
      printf " \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseDeclared\": \"%s\",", license[id]
      printf " \"comment\": \"%s\"}", files[id]
      relations = relations ",\n  {\"spdxElementId\": \"SPDXRef-corvo\", \"relationshipType\": \"" relation[id] "\", \"relatedSpdxElement\": \"" id "\"}"
    }
    printf "\n ],\n \"relationships\": [\n%s\n ]\n}\n", relations
  }'
