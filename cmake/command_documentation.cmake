# SPDX-License-Identifier: MIT
# Writes and installs the shell completions and manual pages of the command.
set(corvo_documentation_dir ${PROJECT_BINARY_DIR}/documentation)
file(MAKE_DIRECTORY ${corvo_documentation_dir})
set(corvo_documentation_files)

# Writes the output of the command with these arguments to a file and installs it.
function(corvo_add_documentation file destination)
  set(output ${corvo_documentation_dir}/${file})
  add_custom_command(OUTPUT ${output}
    COMMAND corvo ${ARGN} > ${output}
    DEPENDS corvo VERBATIM)
  install(FILES ${output} DESTINATION ${CMAKE_INSTALL_DATADIR}/${destination} COMPONENT command)
  set(corvo_documentation_files ${corvo_documentation_files} ${output} PARENT_SCOPE)
endfunction()

corvo_add_documentation(corvo bash-completion/completions completion bash)
corvo_add_documentation(_corvo zsh/site-functions completion zsh)
corvo_add_documentation(corvo.fish fish/vendor_completions.d completion fish)
corvo_add_documentation(corvo.1 man/man1 manual)
foreach(command IN ITEMS run calibrate eval export synth features match learn config)
  corvo_add_documentation(corvo-${command}.1 man/man1 manual ${command})
endforeach()
add_custom_target(corvo_documentation ALL DEPENDS ${corvo_documentation_files})
