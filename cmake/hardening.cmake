# SPDX-License-Identifier: MIT
# Flags that make an error in memory harder to exploit. They are those of Debian's packages: stack
# protector, checked library calls (Release only: they need optimization), position-independent
# executables, and relocations that are read-only from the start on. Sanitizers replace them.
# -D_GLIBCXX_ASSERTIONS is left to the sanitized builds.
include(CheckPIESupported)

set(CORVO_IS_HARDENED FALSE)
if(CORVO_HARDEN AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(CORVO_IS_HARDENED TRUE)
  check_pie_supported(OUTPUT_VARIABLE ignored LANGUAGES CXX)
  target_compile_options(corvo_flags INTERFACE -fstack-protector-strong
    "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  if(NOT APPLE)
    target_link_options(corvo_flags INTERFACE -Wl,-z,relro,-z,now)
  endif()
endif()
