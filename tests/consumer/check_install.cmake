# SPDX-License-Identifier: MIT
# Installs corvo, moves the installation, builds the examples against it and runs them on a rendered
# sequence.
#   cmake -D BUILD=... -D SOURCE=... -D WORK=... [-D ARGUMENTS=...] -P <this>
# ARGUMENTS are for configuring the examples; they match those of the build.

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)

file(GLOB_RECURSE package ${WORK}/moved/*.cmake)
file(GLOB_RECURSE headers ${WORK}/moved/include/*.h)
if(NOT package OR NOT headers)
  message(FATAL_ERROR "no CMake package or no header was installed")
endif()
# Sets `result` to whether a text names an absolute path. The same letters inside a longer path are
# another path: a checkout at /corvo is not named by "${_IMPORT_PREFIX}/include/corvo".
function(names_path text path result)
  string(REGEX REPLACE "([][+.*()^$?|])" "\\\\\\1" pattern "${path}")
  if("${text}" MATCHES "(^|[^A-Za-z0-9_.}/-])${pattern}($|[^A-Za-z0-9_.-])")
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

function(expect_names_path expected text path)
  names_path("${text}" "${path}" result)
  if(NOT result STREQUAL expected)
    message(FATAL_ERROR "names_path: \"${text}\" and ${path} give ${result}; expected is ${expected}")
  endif()
endfunction()

expect_names_path(TRUE "\"/corvo/orb\"" /corvo)
expect_names_path(TRUE "A;/corvo;B" /corvo)
expect_names_path(TRUE "/home/a.b/corvo" /home/a.b/corvo)
expect_names_path(FALSE "/home/a+b/corvo" /home/a.b/corvo)
expect_names_path(FALSE "\"\${_IMPORT_PREFIX}/include/corvo\"" /corvo)
expect_names_path(FALSE "lib/cmake/corvo/corvo-orb.cmake" /corvo)
expect_names_path(FALSE "\"/corvo-0.1/lib\"" /corvo)

foreach(file IN LISTS package)
  file(READ ${file} text)
  foreach(path IN ITEMS ${SOURCE} ${BUILD})
    names_path("${text}" "${path}" is_named)
    if(is_named)
      message(FATAL_ERROR "${file} names ${path}")
    endif()
  endforeach()
endforeach()

# What the libraries are made with is no business of those who use them.
foreach(file IN LISTS headers)
  file(STRINGS ${file} includes REGEX "#include <(ceres|yaml-cpp|fmt|tbb|hwy|opencv2/(calib3d|highgui))")
  if(includes)
    message(FATAL_ERROR "${file} has ${includes}")
  endif()
endforeach()

# Every header that an installed one includes is installed, too.
foreach(file IN LISTS headers)
  file(STRINGS ${file} includes REGEX "^#include \"(orb|vo)/")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" header "${line}")
    if(NOT EXISTS ${WORK}/moved/include/corvo/${header})
      message(FATAL_ERROR "${file} includes ${header}, which is not a public header")
    endif()
  endforeach()
endforeach()

set(corvo ${WORK}/moved/bin/corvo)
run(${corvo} --version)
run(${corvo} config ${WORK}/moved/share/corvo/configs/default.yaml)
run(${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${WORK}/build
    -D CMAKE_PREFIX_PATH=${WORK}/moved ${ARGUMENTS})
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2)

# Runs an example; its standard output must match `expected`.
function(run_example expected name)
  execute_process(COMMAND ${WORK}/build/${name} ${ARGN}
    OUTPUT_VARIABLE output ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "${name} prints \"${output}\"; expected is a match of \"${expected}\"")
  endif()
endfunction()

run(${corvo} synth room -o ${WORK}/room --frames 40)
file(GLOB images ${WORK}/room/rgb/*.png)
list(SORT images COMPARE NATURAL)
list(GET images 0 first)
list(GET images 8 second)
find_program(python python3)
# Black images have no features. A sanitized library needs a sanitized program.
if(python AND NOT "${ARGUMENTS}" MATCHES "-fsanitize")
  run(${python} -c "import ctypes; from sys import argv
extract = ctypes.CDLL(argv[1]).extract_features
assert extract(bytes(640 * 480), 640, 480, ctypes.c_size_t(640), None, 0) == 0"
    ${WORK}/build/libfeatures_plugin.so)
endif()
run_example("(\n[0-9]+ [-0-9.e]+ +[-0-9.e]+ +[-0-9.e]+)+" track_images ${images})
run_example("(\n[0-9.]+ [0-9.]+ [0-7] [0-9.]+ [-0-9.e]+)+" extract_features ${first})
run_example("^[0-9][0-9]+ mutual matches" opencv_features ${first} ${second})
run_example("inliers of .*\ndirection of the baseline" two_views ${first} ${second})
run_example("(room/rgb[^\n]* [0-9]+ +[-0-9.e]+ +[-0-9.e]+ +[-0-9.e]+\n)+" track_by_stages
  ${WORK}/room/camera.yaml ${images})
run_example("frames adjusted: converged.*landmarks" refine_sequence
  ${WORK}/room/camera.yaml ${WORK}/refined.tum ${images})
run_example("^focal length: [0-9.]+ px" calibrate_camera ${WORK}/camera.yaml ${images})
run(${corvo} eval ${WORK}/refined.tum ${WORK}/room/groundtruth.txt)
