#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the libraries that the wheel contains, static and with hidden symbols, from Debian's source
# packages, and prints the folder they are installed in. That folder is named after this script's
# content and the compiler: it is built once, and anew only if a build of it did not end.
#
#   build_wheel_dependencies.sh
#
#   CORVO_WHEEL_DEPENDENCIES   the folder that it lies in; default ~/.cache/corvo (XDG_CACHE_HOME)
set -euo pipefail

# Source packages of Debian 12. All may be part of an MIT-licensed wheel; NOTICE has their licenses.
packages=(
  zlib=1:1.2.13.dfsg-1
  libpng1.6=1.6.39-2+deb12u5
  libjpeg-turbo=1:2.1.5-2
  fmtlib=9.1.0+ds1-2
  spdlog=1:1.10.0+ds-0.4
  yaml-cpp=0.7.0+dfsg-8
  highway=1.0.3-3+deb12u1
  onetbb=2021.8.0-2+deb12u1
  opencv=4.6.0+dfsg-12
  ceres-solver=2.1.0+really2.1.0+dfsg-1
)

usage() { sed -n '3,9s/^# \{0,1\}//p' "$0"; }

# Downloads, verifies, unpacks and patches the source packages. They come from the mirrors of the
# system's own packages; the system's configuration and state stay as they are.
fetch() {
  mkdir -p lists/partial
  local apt=(apt-get -q -o Dir::State::Lists="$PWD/lists" -o Dir::Cache="$PWD/cache"
    -o APT::Sandbox::User=root)
  "${apt[@]}" update
  "${apt[@]}" indextargets --format 'deb-src $(SITE) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' >sources.list
  apt+=(-o Dir::Etc::SourceList="$PWD/sources.list" -o Dir::Etc::SourceParts=-)
  "${apt[@]}" update
  "${apt[@]}" source "${packages[@]}"
}

# Builds and installs the source package whose name begins with the first argument.
build() {
  local name=$1
  shift
  cmake -S "$name"-[0-9]* -B "build/$name" -G Ninja -Wno-dev "${common[@]}" "$@"
  cmake --build "build/$name" --parallel "$(nproc)"
  cmake --install "build/$name" >/dev/null
  keep_license "$name"
}

keep_license() {
  mkdir -p "$prefix/licenses/$1"
  find "$1"-[0-9]* -maxdepth 1 -regex '.*/\(LICENSE\|COPYRIGHT\|README\.ijg\|third-party\).*' \
    -exec cp -t "$prefix/licenses/$1" {} +
}

build_all() {
  build_zlib
  build libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF
  build libjpeg-turbo -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF -DREQUIRE_SIMD=ON
  build fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
  build spdlog -DSPDLOG_BUILD_EXAMPLE=OFF -DSPDLOG_FMT_EXTERNAL=ON
  build yaml-cpp -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF
  build highway -DBUILD_TESTING=OFF -DHWY_ENABLE_CONTRIB=OFF -DHWY_ENABLE_EXAMPLES=OFF
  build onetbb -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_ENABLE_IPO=OFF
  build_opencv
  build_ceres
}

# Debian's package has no CMake project that works.
build_zlib() (
  cd zlib-[0-9]*
  CFLAGS="$flags -fPIC -fvisibility=hidden" ./configure --static --prefix="$prefix"
  make -j "$(nproc)" libz.a
  make install >/dev/null
  cd ..
  keep_license zlib
)

# What corvo's results depend on is as in Debian's OpenCV: the instruction sets, the optimization, and
# Eigen, with which essential matrices are estimated. It starts no threads.
build_opencv() {
  local unwanted=(ADE GTK IMGCODEC_HDR IMGCODEC_PFM IMGCODEC_SUNRASTER IPP ITT JASPER LAPACK OPENCL
    OPENEXR OPENJPEG PROTOBUF PTHREADS_PF QUIRC TIFF VA VTK WEBP)
  unwanted=("${unwanted[@]/#/-DWITH_}")
  build opencv "${unwanted[@]/%/=OFF}" -DBUILD_LIST=calib3d,imgcodecs \
    -DWITH_EIGEN=ON -DCPU_BASELINE=SSE2 -DCPU_BASELINE_DISABLE=SSE3 -DCV_TRACE=OFF \
    -DBUILD_TESTS=OFF -DBUILD_PERF_TESTS=OFF -DBUILD_JAVA=OFF -DBUILD_opencv_apps=OFF \
    -DOPENCV_GENERATE_SETUPVARS=OFF -DENABLE_CCACHE=OFF \
    -DENABLE_PRECOMPILED_HEADERS=ON "-DCMAKE_CXX_FLAGS=-isystem /usr/include/eigen3"
  cp -t "$prefix/licenses/opencv" "$prefix"/share/licenses/opencv4/*
}

# It prints only what ends the program: corvo reports how its adjustments end.
# Its solvers by the Schur complement are compiled only for the sizes of corvo's blocks (residuals,
# points, poses), and for any size: each of the other 19 takes 20 s.
build_ceres() {
  (
    cd ceres-solver-[0-9]*/internal/ceres
    sed -i '/^SPECIALIZATIONS/,/)]$/c SPECIALIZATIONS = [(2, 3, 6), (2, 3, "Eigen::Dynamic")]' \
      generate_template_specializations.py
    /usr/bin/python3 generate_template_specializations.py
  )
  build ceres-solver -DMINIGLOG=ON -DMINIGLOG_MAX_LOG_LEVEL=-3 -DEIGENSPARSE=ON -DSUITESPARSE=OFF -DCXSPARSE=OFF -DLAPACK=OFF \
    -DGFLAGS=OFF -DCUDA=OFF -DBUILD_TESTING=OFF -DBUILD_EXAMPLES=OFF -DBUILD_BENCHMARKS=OFF
}

if [ $# -gt 0 ]; then
  usage >&2
  exit 1
fi
root=$(realpath -m "${CORVO_WHEEL_DEPENDENCIES:-${XDG_CACHE_HOME:-$HOME/.cache}/corvo}")
key=$({ cat "${BASH_SOURCE[0]}" && c++ --version; } | sha256sum | cut -c 1-16)
prefix=$root/wheel-dependencies-$key
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags="-O2 -DNDEBUG -fstack-protector-strong -D_FORTIFY_SOURCE=2"
flags+=" -ffunction-sections -fdata-sections -ffile-prefix-map=$work/="
common=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR:STRING=lib
  -DCMAKE_PREFIX_PATH="$prefix" -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON
  -DCMAKE_C_VISIBILITY_PRESET=hidden -DCMAKE_CXX_VISIBILITY_PRESET=hidden
  -DCMAKE_VISIBILITY_INLINES_HIDDEN=ON "-DCMAKE_C_FLAGS_RELEASE=$flags"
  "-DCMAKE_CXX_FLAGS_RELEASE=$flags")

mkdir -p "$root"
exec 9>"$prefix.lock"
flock 9  # Of two builds at a time the second waits, and finds all done.
if [ ! -e "$prefix/complete" ]; then
  rm -rf "$prefix"
  cd "$work"
  { fetch; build_all; } >&2
  touch "$prefix/complete"
fi
echo "$prefix"
