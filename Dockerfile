# SPDX-License-Identifier: MIT
# The command corvo on a slim Debian 12:
#   docker build -t corvo .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/data" corvo run drive.mp4 --focal auto -o result
FROM debian:12-slim AS build
RUN apt-get update \
  && apt-get install -y --no-install-recommends dpkg-dev file \
  && rm -rf /var/lib/apt/lists/*
COPY scripts/install_dependencies.sh /corvo/scripts/
RUN /corvo/scripts/install_dependencies.sh && rm -rf /var/lib/apt/lists/*
COPY . /corvo
WORKDIR /corvo
ARG SOURCE_DATE_EPOCH
RUN cmake --preset release -D CORVO_BUILD_TESTS=OFF -D CORVO_BUILD_BENCHMARKS=OFF \
  && scripts/build_packages.sh /packages

FROM debian:12-slim
RUN --mount=type=bind,from=build,source=/packages,target=/packages \
  apt-get update \
  && apt-get install -y --no-install-recommends /packages/corvo_*.deb gnuplot-nox \
  && rm -rf /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["corvo"]
CMD ["--help"]
