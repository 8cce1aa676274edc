// SPDX-License-Identifier: MIT
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/unique_ptr.h>

#include "orb/error.h"
#include "orb/extractor.h"
#include "orb/lsh_index.h"
#include "orb/matcher.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/checked_arrays.h"
#include "python/src/images.h"
#include "vo/core/options.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

template <typename Scalar>
using View = NumpyArray<const Scalar, -1>;
using PixelView = NumpyArray<const float, -1, 2>;
using DescriptorArray = NumpyArray<const std::uint8_t, -1, 32>;
using Matches = NumpyArray<std::int32_t, -1, 3>;
using Neighbors = NumpyArray<std::int32_t, -1, -1>;
using FeaturesHandle = nb::pointer_and_handle<orb::Features>;

static_assert(sizeof(orb::Keypoint) % sizeof(float) == 0 && sizeof(int) == sizeof(float));
constexpr std::int64_t kKeypointStride = sizeof(orb::Keypoint) / sizeof(float);

/// Returns a view of a field of every keypoint.
template <auto Field>
auto FieldOf(FeaturesHandle features) {
  using Scalar = std::remove_cvref_t<decltype(std::declval<orb::Keypoint>().*Field)>;
  const std::vector<orb::Keypoint>& keypoints = features.p->keypoints;
  const Scalar* const first = keypoints.empty() ? nullptr : &(keypoints.front().*Field);
  return View<Scalar>(first, {keypoints.size()}, features.h, {kKeypointStride});
}

PixelView PixelsOf(FeaturesHandle features) {
  const std::vector<orb::Keypoint>& keypoints = features.p->keypoints;
  const float* const first = keypoints.empty() ? nullptr : &keypoints.front().x;
  return PixelView(first, {keypoints.size(), 2}, features.h, {kKeypointStride, 1});
}

DescriptorArray DescriptorsOf(FeaturesHandle features) {
  const std::vector<orb::Descriptor>& descriptors = features.p->descriptors;
  const auto* const first = descriptors.empty() ? nullptr : descriptors.front().bytes.data();
  return DescriptorArray(first, {descriptors.size(), 32}, features.h);
}

orb::Features Extract(const orb::Extractor& extractor, nb::handle image, nb::handle mask) {
  const cv::Mat gray = ToGrayImage(image);
  const cv::Mat used = ToMask(mask);
  const nb::gil_scoped_release release;
  return extractor.Extract(gray, used);
}

std::vector<orb::Match> FindMatches(std::span<const orb::Descriptor> first,
                                    std::span<const orb::Descriptor> second, int max_distance,
                                    double ratio, bool is_mutual) {
  const std::vector<orb::Nearest> nearest = orb::FindNearest(first, second);
  const std::vector<orb::Match> matches =
      orb::DistanceTest(orb::RatioTest(nearest, ratio), max_distance);
  return is_mutual ? orb::CrossCheck(matches, orb::FindNearest(second, first)) : matches;
}

Matches Match(nb::handle first, nb::handle second, int max_distance, double ratio, bool is_mutual) {
  const DescriptorView a(first, "first");
  const DescriptorView b(second, "second");
  std::vector<std::int32_t> rows;
  {
    const nb::gil_scoped_release release;
    for (const orb::Match& match :
         FindMatches(a.span(), b.span(), max_distance, ratio, is_mutual)) {
      rows.insert(rows.end(), {match.query, match.train, match.distance});
    }
  }
  const std::size_t count = rows.size() / 3;
  return MoveToArray<Matches>(std::move(rows), {count, 3});
}

/// An index that several Python threads may use: searches run at once, additions alone.
class SharedIndex {
 public:
  explicit SharedIndex(orb::LshIndex index) : index_(std::move(index)) {}

  void Add(nb::handle descriptors) {
    const DescriptorView added(descriptors, "descriptors");
    const nb::gil_scoped_release release;
    const std::unique_lock lock(mutex_);
    index_.Add(added.span());
  }

  std::pair<Neighbors, Neighbors> FindNearest(nb::handle descriptors, int k) const {
    const DescriptorView queries(descriptors, "descriptors");
    const std::size_t count = queries.span().size();
    CheckRange("k", k, 1, 1'000'000);
    std::vector<std::int32_t> indices(count * k, -1);
    std::vector<std::int32_t> distances(count * k, 257);
    Search(queries.span(), k, indices, distances);
    const std::initializer_list<std::size_t> shape = {count, static_cast<std::size_t>(k)};
    return {MoveToArray<Neighbors>(std::move(indices), shape),
            MoveToArray<Neighbors>(std::move(distances), shape)};
  }

  void Save(const std::filesystem::path& file) const {
    const std::shared_lock lock(mutex_);
    index_.Save(file);
  }

  int size() const {
    const std::shared_lock lock(mutex_);
    return index_.size();
  }

 private:
  void Search(std::span<const orb::Descriptor> queries, int k, std::vector<std::int32_t>& indices,
              std::vector<std::int32_t>& distances) const {
    const nb::gil_scoped_release release;
    const std::shared_lock lock(mutex_);
    for (std::size_t query = 0; query < queries.size(); ++query) {
      std::size_t place = query * k;
      for (const orb::Neighbor& neighbor : index_.FindNearest(queries[query], k)) {
        indices[place] = neighbor.index;
        distances[place++] = neighbor.distance;
      }
    }
  }

  mutable std::shared_mutex mutex_;
  orb::LshIndex index_;
};

void BindFeatures(nb::module_& module) {
  nb::class_<orb::Features>(module, "Features",
                            "Keypoints and their descriptors, with equal indices. The arrays share "
                            "the memory of this object and are read-only.")
      .def_prop_ro(
          "pixels", &PixelsOf,
          "float32 of shape (n, 2): x, y in the input image, px; integers are pixel centers.")
      .def_prop_ro("angles_deg", &FieldOf<&orb::Keypoint::angle_deg>,
                   "float32 of shape (n,): direction from x towards y, [0, 360).")
      .def_prop_ro("responses", &FieldOf<&orb::Keypoint::response>,
                   "float32 of shape (n,): the score that ranked the keypoints.")
      .def_prop_ro("octaves", &FieldOf<&orb::Keypoint::octave>,
                   "int32 of shape (n,): pyramid level of the detection; 0 is the finest.")
      .def_prop_ro("descriptors", &DescriptorsOf,
                   "uint8 of shape (n, 32): 256 binary tests; test i is bit i % 8 of byte i // 8.")
      .def("__len__", [](const orb::Features& features) { return features.keypoints.size(); });
}

void BindExtractor(nb::module_& module) {
  nb::class_<orb::Extractor>(module, "Extractor",
                             R"(Extracts ORB features. Several threads may share an extractor.

Args:
    options: The options, of which the section `extractor` is used.
    threads: Number of pyramid levels that are processed in parallel, 1 to 256; it does not affect
        the result.

Raises:
    Error: `threads` is out of range.)")
      .def(
          "__init__",
          [](orb::Extractor* self, const OdometryOptions& options, int threads) {
            new (self) orb::Extractor(options.extractor, threads);
          },
          nb::arg("options") = OdometryOptions(), nb::arg("threads") = 1)
      .def("__call__", &Extract, nb::arg("image").none(), nb::arg("mask") = nb::none(),
           nb::sig("def __call__(self, image: numpy.typing.NDArray[numpy.uint8], "
                   "mask: numpy.typing.NDArray[numpy.uint8] | None = None) -> Features"),
           R"(Detects and describes keypoints.

Args:
    image: uint8, (height, width) for gray or (height, width, 3) for RGB, as for Odometry.process.
    mask: uint8 of shape (height, width): keypoints are detected only where it is not 0.

Raises:
    Error: An array has another dtype, shape or size.)");
}

void BindIndex(nb::module_& module) {
  nb::class_<SharedIndex>(module, "LshIndex",
                          R"(Finds nearest neighbors among millions of descriptors.

Args:
    num_tables: Hash tables, 1 to 12.
    max_flips: Bits of a key that are flipped at most, 0 to 21.
    recall: Probability with which a search finds its nearest neighbors, 0 to 1.

Raises:
    Error: An argument is out of range.)")
      .def(
          "__init__",
          [](SharedIndex* self, int num_tables, int max_flips, double recall) {
            new (self)
                SharedIndex(orb::LshIndex(orb::LshIndexOptions{num_tables, max_flips, recall}));
          },
          nb::arg("num_tables") = 8, nb::arg("max_flips") = 2, nb::arg("recall") = 0.8)
      .def("add", &SharedIndex::Add, nb::arg("descriptors").none(),
           nb::sig("def add(self, descriptors: numpy.typing.NDArray[numpy.uint8]) -> None"),
           "Appends descriptors, uint8 of shape (n, 32); the first has the index len(self).")
      .def("find_nearest", &SharedIndex::FindNearest, nb::arg("descriptors").none(),
           nb::arg("k") = 1,
           nb::sig(
               "def find_nearest(self, descriptors: numpy.typing.NDArray[numpy.uint8], k: int = 1)"
               " -> tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32]]"),
           R"(Finds the k nearest neighbors of descriptors, uint8 of shape (n, 32).

Returns:
    Indices and distances (bits), int32 of shape (n, k), nearest first; -1 and 257 where there are
    fewer.)")
      .def("save", &SharedIndex::Save, nb::arg("file"), nb::call_guard<nb::gil_scoped_release>(),
           "Writes a file for load(). Raises Error if it cannot be written.")
      .def_static(
          "load",
          [](const std::filesystem::path& file) {
            return std::make_unique<SharedIndex>(orb::LshIndex::Load(file));
          },
          nb::arg("file"), nb::call_guard<nb::gil_scoped_release>(),
          "Reads a file of save(). Raises Error if it cannot be read or is damaged.")
      .def("__len__", &SharedIndex::size);
}

}  // namespace

void BindOrb(nb::module_& module) {
  BindFeatures(module);
  BindExtractor(module);
  BindIndex(module);
  module.def("match", &Match, nb::arg("first").none(), nb::arg("second").none(),
             nb::arg("max_distance") = 65, nb::arg("ratio") = 0.8, nb::arg("is_mutual") = true,
             nb::sig("def match(first: numpy.typing.NDArray[numpy.uint8], "
                     "second: numpy.typing.NDArray[numpy.uint8], max_distance: int = 65, "
                     "ratio: float = 0.8, is_mutual: bool = True) -> "
                     "numpy.typing.NDArray[numpy.int32]"),
             R"(Matches descriptors by their exact nearest neighbors.

Args:
    first, second: uint8 of shape (n, 32).
    max_distance: Largest distance of a match, bits.
    ratio: A match is nearer than this share of the distance of the second nearest.
    is_mutual: Whether a match must be the nearest neighbor in both directions.

Returns:
    int32 of shape (m, 3): index in `first`, index in `second`, distance in bits.

Raises:
    Error: An array has another dtype or shape.)");
}

}  // namespace corvo::python
