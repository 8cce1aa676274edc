# Installs corvo, moves the installation, and builds and runs the consumer against it.
#   cmake -D BUILD=... -D CONSUMER=... -D WORK=... -D SOURCE=... [-D ARGUMENTS=...] -P <this>
# ARGUMENTS are for configuring the consumer; they match those of the build.

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
foreach(file IN LISTS package)
  file(READ ${file} text)
  foreach(path IN ITEMS ${SOURCE} ${BUILD})
    string(FIND "${text}" ${path} position)
    if(NOT position EQUAL -1)
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

run(${WORK}/moved/bin/corvo --version)
run(${WORK}/moved/bin/corvo config ${WORK}/moved/share/corvo/configs/default.yaml)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -D CMAKE_PREFIX_PATH=${WORK}/moved ${ARGUMENTS})
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2)
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build --output-on-failure)
