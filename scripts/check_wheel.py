#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that a wheel is small, self-contained and MIT-compatible: check_wheel.py WHEEL.

Needs pyelftools. Prints every fault and exits with 1 if there is any.
"""

import io
import re
import sys
import zipfile
from pathlib import Path

from elftools.elf.elffile import ELFFile

MAX_PACKED_BYTES = 8_000_000
# glibc, libstdc++ and libgcc: what every system with a C++ program has.
SYSTEM_LIBRARIES = {
    "ld-linux-x86-64.so.2", "libc.so.6", "libgcc_s.so.1", "libm.so.6", "libstdc++.so.6",
}
EXPORTED_SYMBOLS = {"PyInit__corvo"}
# What is in the files of libraries under the GPL or for windows, whether linked or loaded.
FORBIDDEN_TEXTS = (b"CHOLMOD", b"cholmod", b"Lavc", b"libavcodec", b"x264", b"libX11", b"libGL")


def size_faults(wheel):
    size = wheel.stat().st_size
    if size > MAX_PACKED_BYTES:
        yield f"{wheel.name} has {size} bytes; at most {MAX_PACKED_BYTES} are allowed"


def tag_faults(wheel):
    if "-manylinux_" not in wheel.name:
        yield f"{wheel.name} has no manylinux tag"


def needed_libraries(elf):
    return {tag.needed for tag in elf.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")}


def exported_symbols(elf):
    return {
        symbol.name for symbol in elf.get_section_by_name(".dynsym").iter_symbols()
        if symbol.name and symbol["st_shndx"] != "SHN_UNDEF"
    }


def library_faults(name, content):
    elf = ELFFile(io.BytesIO(content))
    for library in sorted(needed_libraries(elf) - SYSTEM_LIBRARIES):
        yield f"{name} needs {library}"
    if exported_symbols(elf) != EXPORTED_SYMBOLS:
        yield f"{name} exports {sorted(exported_symbols(elf))}, not {sorted(EXPORTED_SYMBOLS)}"
    for text in FORBIDDEN_TEXTS:
        if text in content:
            yield f"{name} contains {text.decode()!r}"


def content_faults(archive):
    libraries = [name for name in archive.namelist() if ".so" in Path(name).name]
    if len(libraries) != 1:
        yield f"there are {len(libraries)} libraries, not 1: {libraries}"
    for name in libraries:
        yield from library_faults(name, archive.read(name))


def noticed_libraries(notice):
    """Returns the names in NOTICE's table of the libraries in the wheel."""
    table = re.search(r"^library +version +license\n((?:\S.*\n)+)", notice, re.MULTILINE)
    return {row.split()[0] for row in table[1].splitlines()} if table else set()


def license_faults(archive):
    licenses = {}  # A file of each license, by its name.
    for name in archive.namelist():
        match = re.fullmatch(r"[^/]+\.dist-info/licenses/([^/]+)(/.+)?", name)
        if match:
            licenses[match[1]] = name
    notice = archive.read(licenses["NOTICE"]).decode() if "NOTICE" in licenses else ""
    for name in sorted((noticed_libraries(notice) | {"LICENSE", "NOTICE"}) ^ licenses.keys()):
        yield f"NOTICE and the licenses in the wheel differ in {name}"


def main():
    wheel = Path(sys.argv[1])
    with zipfile.ZipFile(wheel) as archive:
        faults = [*size_faults(wheel), *tag_faults(wheel), *content_faults(archive),
                  *license_faults(archive)]
    for fault in faults:
        print(f"check_wheel.py: {fault}", file=sys.stderr)
    print(f"{wheel.name}: {wheel.stat().st_size} bytes, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
