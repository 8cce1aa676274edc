# SPDX-License-Identifier: MIT
# CPack runs this on the installed files before it makes the Debian packages of them: what Debian's
# policy asks for beyond an installation.
cmake_policy(VERSION 3.22)

# The system's libraries that dpkg-shlibdeps looks at are those of a cross-compiled package.
if(CPACK_DEBIAN_PACKAGE_ARCHITECTURE)
  set(ENV{DEB_HOST_ARCH} ${CPACK_DEBIAN_PACKAGE_ARCHITECTURE})
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(command_root ${CPACK_TEMPORARY_DIRECTORY}/command/usr)
set(development_root ${CPACK_TEMPORARY_DIRECTORY}/development/usr)

# Packages of which code is in the programs, as headers or static libraries: their licenses go along.
set(compiled_packages libceres-dev libeigen3-dev libcli11-dev nlohmann-json3-dev)

function(write_documentation root package)
  set(documentation ${root}/share/doc/${package})
  file(MAKE_DIRECTORY ${documentation})
  file(COPY_FILE ${CPACK_CORVO_SOURCE_DIR}/CHANGELOG.md ${documentation}/changelog)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${documentation}/changelog.Debian
    "corvo (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * Version ${CPACK_PACKAGE_VERSION}; changelog.gz tells what changed.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  run(gzip --best --no-name ${documentation}/changelog ${documentation}/changelog.Debian)
  file(COPY ${CPACK_CORVO_SOURCE_DIR}/NOTICE DESTINATION ${documentation})
  file(READ ${CPACK_CORVO_SOURCE_DIR}/LICENSE license)
  file(WRITE ${documentation}/copyright "${license}")
endfunction()

function(append_licenses_of_compiled_packages file)
  foreach(package IN LISTS compiled_packages)
    file(READ /usr/share/doc/${package}/copyright license)
    string(REPEAT "-" 80 line)
    file(APPEND ${file} "\n${line}\nThe programs contain code of the package ${package}:\n\n${license}")
  endforeach()
endfunction()

write_documentation(${command_root} corvo)
append_licenses_of_compiled_packages(${command_root}/share/doc/corvo/copyright)
file(COPY ${CPACK_CORVO_SOURCE_DIR}/README.md ${CPACK_CORVO_SOURCE_DIR}/docs
  DESTINATION ${command_root}/share/doc/corvo
  PATTERN Doxyfile EXCLUDE)
file(GLOB manuals ${command_root}/share/man/man1/*)
run(gzip --best --no-name ${manuals})
file(GLOB programs ${command_root}/bin/corvo ${command_root}/lib/corvo/modules/*.so)
run(${CPACK_CORVO_STRIP} --remove-section=.comment ${programs})
file(RENAME ${command_root}/share/zsh/site-functions ${command_root}/share/zsh/vendor-completions)

write_documentation(${development_root} libcorvo-dev)
file(COPY ${CPACK_CORVO_SOURCE_DIR}/examples DESTINATION ${development_root}/share/doc/libcorvo-dev)
file(GLOB archives ${development_root}/lib/*.a)
run(${CPACK_CORVO_STRIP} --strip-debug --remove-section=.comment --enable-deterministic-archives
  ${archives})
