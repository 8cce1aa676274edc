// SPDX-License-Identifier: MIT
// Images that are taken when a camera delivers them.
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "apps/codecs/codecs.h"
#include "apps/dataset/image_reader.h"
#include "apps/dataset/image_source.h"
#include "apps/output/realtime_report.h"
#include "apps/run/realtime_images.h"
#include "apps/system/interruption.h"
#include "orb/error.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo {
namespace {

using std::chrono::milliseconds;

/// Images every `interval_ns`, numbered from 0; the one with the index `error_at` cannot be read.
class NumberedImages : public ImageReader {
 public:
  NumberedImages(int count, TimeNs interval_ns, int error_at = -1)
      : count_(count), interval_ns_(interval_ns), error_at_(error_at) {}

  std::optional<TimedImage> Read() override {
    if (next_ == count_) return std::nullopt;
    if (next_ == error_at_) throw Error("the bag is damaged");
    TimedImage image;
    image.image = cv::Mat(16, 16, CV_8U, cv::Scalar(0));
    image.index = next_++;
    image.time_ns = image.index * interval_ns_;
    return image;
  }
  bool Skip() override { return next_ != count_ && ++next_ > 0; }

 private:
  int next_ = 0;
  int count_;
  TimeNs interval_ns_;
  int error_at_;
};

ImageSource Numbered(int count, TimeNs interval_ns, int error_at = -1) {
  return {{}, std::make_unique<NumberedImages>(count, interval_ns, error_at), {}};
}

TEST(RealtimeImages, DeliversAllImagesToAConsumerThatKeepsUp) {
  const Interruption interruption;
  ImageSource source = Numbered(4, 200'000'000);
  RealtimeImages images(source, interruption);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 4; ++i) {
    const std::optional<TimedImage> image = images.Next();
    ASSERT_TRUE(image);
    EXPECT_EQ(image->index, i);
    EXPECT_GE(images.LatencyMs(), 0);
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(599));
  EXPECT_FALSE(images.Next());
  EXPECT_EQ(images.num_dropped(), 0);
}

TEST(RealtimeImages, DropsAllButTheNewestWhileTheConsumerIsBusy) {
  const Interruption interruption;
  ImageSource source = Numbered(50, 1'000'000);
  RealtimeImages images(source, interruption);
  int num_taken = 0, last = -1;
  while (const std::optional<TimedImage> image = images.Next()) {
    EXPECT_GT(image->index, last);
    last = image->index;
    ++num_taken;
    std::this_thread::sleep_for(milliseconds(30));
  }
  EXPECT_EQ(last, 49);
  EXPECT_LT(num_taken, 25);
  EXPECT_EQ(num_taken + images.num_dropped(), 50);
}

TEST(RealtimeImages, ThrowsTheErrorOfTheSourceAfterTheImagesBeforeIt) {
  const Interruption interruption;
  ImageSource source = Numbered(5, 0, 2);
  RealtimeImages images(source, interruption);
  EXPECT_THROW(while (images.Next()){}, Error);
}

TEST(RealtimeImages, EndsWhileImagesAreStillToCome) {
  const Interruption interruption;
  ImageSource source = Numbered(2, 3'600'000'000'000);
  RealtimeImages images(source, interruption);
  EXPECT_TRUE(images.Next());
}

/// A camera that delivers some images and then no more.
class EndingCamera : public VideoInput {
 public:
  explicit EndingCamera(int num_images) : num_left_(num_images) {}

  bool Grab() override { return num_left_-- > 0; }
  bool Retrieve(cv::Mat& image) override {
    image = cv::Mat(16, 16, CV_8U, cv::Scalar(0));
    return true;
  }
  double Get(VideoProperty) const override { return 0; }

 private:
  int num_left_;
};

TEST(OpenCamera, TakesACameraUpAgainThatHasStopped) {
  std::vector<std::unique_ptr<VideoInput>> inputs;  // The last one first; null: it is not there.
  inputs.push_back(std::make_unique<EndingCamera>(3));
  inputs.push_back(nullptr);
  inputs.push_back(std::make_unique<EndingCamera>(2));
  const auto camera = OpenCamera(
      [&] {
        auto input = std::move(inputs.back());
        inputs.pop_back();
        return input;
      },
      "camera:7");
  TimeNs before = -1;
  for (int i = 0; i < 5; ++i) {
    const std::optional<TimedImage> image = camera->Read();
    ASSERT_TRUE(image);
    EXPECT_GT(image->time_ns, before);
    before = image->time_ns;
  }
  EXPECT_TRUE(inputs.empty());
}

TEST(OpenCamera, EndsTheWaitWhenCanceled) {
  int num_opened = 0;
  const auto camera = OpenCamera(
      [&]() -> std::unique_ptr<VideoInput> {
        if (num_opened++ > 0) return nullptr;
        return std::make_unique<EndingCamera>(1);
      },
      "camera:7");
  EXPECT_TRUE(camera->Read());
  std::thread canceling([&] { camera->Cancel(); });
  EXPECT_FALSE(camera->Read());
  canceling.join();
  EXPECT_FALSE(camera->Read());
}

TEST(OpenCamera, FailsWithoutACameraOrAnyImage) {
  EXPECT_THROW(OpenCamera([] { return nullptr; }, "camera:7"), Error);
  const auto camera = OpenCamera([] { return std::make_unique<EndingCamera>(0); }, "camera:7");
  EXPECT_FALSE(camera->Read());
}

TEST(Realtime, ARunAccountsForEveryImage) {
  const test::TemporaryFolder folder;
  test::WriteKitti(folder.path() / "sequence", 5);
  const auto result = folder.path() / "result";
  const auto run = test::RunCorvo(
      {"run", (folder.path() / "sequence").string(), "--realtime", "-o", result.string()});
  EXPECT_EQ(run.exit_code, test::kNeverInitialized);
  EXPECT_THAT(run.out, testing::HasSubstr("real time: "));
  const auto environment = nlohmann::json::parse(test::ReadText(result / "environment.json"));
  const int num_processed = test::CountLines(test::ReadText(result / "frames.csv")) - 1;
  EXPECT_EQ(num_processed + environment["realtime"]["dropped"].get<int>(), 5);
  EXPECT_GE(environment["realtime"]["latency_ms"]["max"],
            environment["realtime"]["latency_ms"]["median"]);
  EXPECT_EQ(test::CountLines(test::ReadText(result / "timing.csv")), num_processed + 1);
}

TEST(RealtimeReport, HasTheLatenciesIfThereWasAnImage) {
  EXPECT_EQ(ToText(RealtimeReport{2, {1, 2, 3}}),
            "real time: 3 images, 2 dropped; latency: median 2.0 ms, p99 3.0 ms, max 3.0 ms\n");
  EXPECT_EQ(ToText(RealtimeReport{0, {}}), "real time: 0 images, 0 dropped\n");
  EXPECT_EQ(ToJson(RealtimeReport{0, {}}).dump(), R"({"dropped":0})");
  EXPECT_EQ(ToJson(RealtimeReport{2, {1, 2, 3}})["latency_ms"]["median"], 2);
}

}  // namespace
}  // namespace corvo
