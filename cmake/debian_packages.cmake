# SPDX-License-Identifier: MIT
# The Debian packages that `cpack -G DEB` makes of the installation: corvo, which has the command,
# and libcorvo-dev, which has the libraries. They belong to the release of the distribution that
# they are built on, since static libraries fit the headers that they were compiled with.
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release os_release)
endif()
string(REGEX REPLACE ".*;?ID=\"?([a-z]+).*" "\\1" distribution ";${os_release}")
string(REGEX REPLACE ".*VERSION_ID=\"?([0-9.]+).*" "\\1" distribution_version "${os_release}")

# Sets `result` to dependencies on packages in the minor version of what was found here.
function(same_minor_version result version)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" minor "${version}")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  set(dependencies)
  foreach(package IN LISTS ARGN)
    list(APPEND dependencies "${package} (>= ${minor})" "${package} (<< ${CMAKE_MATCH_1}.${next}~)")
  endforeach()
  list(APPEND ${result} ${dependencies})
  set(${result} "${${result}}" PARENT_SCOPE)
endfunction()

set(development_dependencies g++ "libtbb-dev (>= ${TBB_VERSION})")
same_minor_version(development_dependencies "${Eigen3_VERSION}" libeigen3-dev)
same_minor_version(development_dependencies "${OpenCV_VERSION}" libopencv-dev)
same_minor_version(development_dependencies "${Ceres_VERSION}" libceres-dev)
same_minor_version(development_dependencies "${hwy_VERSION}" libhwy-dev)
same_minor_version(development_dependencies "${fmt_VERSION}" libfmt-dev)
same_minor_version(development_dependencies "${yaml-cpp_VERSION}" libyaml-cpp-dev)
list(JOIN development_dependencies ", " development_dependencies)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME corvo)
set(CPACK_PACKAGE_CONTACT "The corvo authors <corvo@localhost>" CACHE STRING
  "Maintainer of the Debian packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL command development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~${distribution}${distribution_version})
set(CPACK_DEBIAN_PACKAGE_SOURCE corvo)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME corvo)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "monocular visual odometry: images to a camera trajectory
The command corvo turns the images of one camera (a folder, a video, a
sequence of a public benchmark) into the trajectory of the camera, a sparse
map and a report on every frame. It estimates the camera while it tracks,
gives every pose a covariance, and exports to COLMAP and nerfstudio.
.
It draws trajectories with gnuplot if that is installed.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcorvo-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${development_dependencies}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "monocular visual odometry in C++ (development files)
Headers, static libraries, the CMake package and examples of corvo, which
turns the images of one camera into its trajectory and a sparse map. The
targets are corvo::vo, the odometry and its stages, corvo::orb, the features
alone, and corvo::opencv, the features behind cv::Feature2D.")

set(CPACK_CORVO_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_CORVO_STRIP ${CMAKE_STRIP})
include(CPack)
