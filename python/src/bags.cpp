// SPDX-License-Identifier: MIT
#include "python/src/bags.h"

#include <cstdint>
#include <memory>
#include <utility>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include "apps/dataset/ros_image.h"
#include "orb/error.h"
#include "python/src/bindings.h"
#include "python/src/images.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// Returns what `work` returns, with the GIL held. Exceptions of Python become corvo::Error.
template <typename Work>
auto RunPython(Work&& work) {
  const nb::gil_scoped_acquire acquire;
  try {
    return work();
  } catch (const nb::python_error& error) {
    throw Error(nb::str(error.value()).c_str());
  }
}

BagImage ToBagImage(nb::handle message) {
  const auto data =
      nb::cast<nb::ndarray<const std::uint8_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>>(
          message.attr("data"));
  BagImage image;
  image.time_ns = nb::cast<std::int64_t>(message.attr("time_ns"));
  image.data.assign(reinterpret_cast<const char*>(data.data()), data.size());
  image.encoding = nb::cast<std::string>(message.attr("encoding"));
  image.width = nb::cast<std::int64_t>(message.attr("width"));
  image.height = nb::cast<std::int64_t>(message.attr("height"));
  image.step = nb::cast<std::int64_t>(message.attr("step"));
  image.is_big_endian = nb::cast<bool>(message.attr("is_big_endian"));
  return image;
}

/// A corvo.bags.Bag.
class PythonBag : public BagInput {
 public:
  PythonBag(const std::string& bag, const std::string& topic) {
    RunPython([&] {
      nb::object opened = nb::module_::import_("corvo.bags").attr("Bag")(bag, topic);
      messages_ = opened.attr("messages")();
      bag_ = std::move(opened);
    });
  }
  PythonBag(const PythonBag&) = delete;
  PythonBag& operator=(const PythonBag&) = delete;
  ~PythonBag() override {
    const nb::gil_scoped_acquire acquire;
    message_.reset();
    messages_.reset();
    bag_.reset();
  }

  int num_images() const override {
    return RunPython([&] { return static_cast<int>(nb::len(bag_)); });
  }

  std::string calibration() const override {
    return RunPython([&] { return nb::cast<std::string>(bag_.attr("calibration")); });
  }

  bool Grab() override {
    return RunPython([&] {
      message_ = nb::module_::import_("builtins").attr("next")(messages_, nb::none());
      return !message_.is_none();
    });
  }

  BagImage Retrieve() const override {
    return RunPython([&] { return ToBagImage(message_); });
  }

 private:
  nb::object bag_, messages_, message_;
};

nb::object MessageToGray(nb::handle message, const std::string& name) {
  const BagImage image = ToBagImage(message);
  return ToArray([&] {
    const nb::gil_scoped_release release;
    return RosImageToGray(image, name);
  }());
}

}  // namespace

std::unique_ptr<BagInput> OpenPythonBag(const std::string& bag, const std::string& topic) {
  return std::make_unique<PythonBag>(bag, topic);
}

void BindBags(nb::module_& module) {
  module.def("message_to_gray", &MessageToGray, nb::arg("message"), nb::arg("name"),
             nb::sig("def message_to_gray(message: object, name: str) -> numpy.typing.NDArray["
                     "numpy.uint8 | numpy.uint16]"),
             R"(Converts the image of a corvo.bags.ImageMessage to gray as `corvo run` does.

Args:
    message: The message.
    name: The start of error messages.

Returns:
    uint8 or uint16 of shape (height, width).

Raises:
    Error: The image is damaged, or its encoding is not known.)");
}

}  // namespace corvo::python
