// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "apps/dataset/image_source.h"
#include "tests/cli/command.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr TimeNs kFirst = 1305031102175304000;

class ListsOfImages : public testing::Test {
 protected:
  ListsOfImages() { WriteTum(tum_, 3); }

  /// Lists the images of a TUM sequence whose rgb.txt is changed.
  ImageList ListWith(const std::string& text) const {
    WriteText(tum_ / "rgb.txt", text);
    return ListImages(tum_);
  }

  TemporaryFolder folder_;
  fs::path tum_ = folder_ / "tum";
  std::string time_ = "1305031102.175304";
  std::string file_ = "rgb/1305031102.175304.png";
};

TEST_F(ListsOfImages, AreReadAsPeopleHaveThem) {
  for (const std::string& text :
       {"\xEF\xBB\xBF" + time_ + " " + file_,
        "timestamp filename\r\n" + time_ + " " + file_ + "\r\n", time_ + "," + file_,
        time_ + "; " + file_ + "\r", time_ + "\t" + file_, "1.305031102175304e+09 " + file_,
        "1305031102175304 " + file_, "1305031102175304000 " + file_,
        "1.305031102175304000e18, " + file_, time_ + " " + file_ + " " + time_ + " depth/1.png"}) {
    const ImageList list = ListWith(text);
    ASSERT_EQ(list.images.size(), 1u) << text;
    EXPECT_EQ(list.images[0].time_ns, kFirst) << text;
    EXPECT_EQ(list.images[0].file, tum_ / file_) << text;
  }
}

TEST_F(ListsOfImages, MayHaveNamesWithBlanks) {
  WriteImage(tum_ / "my images/a b.png", TinyImage(1));
  EXPECT_EQ(ListWith(time_ + " my images/a b.png\n").images[0].file, tum_ / "my images/a b.png");
}

TEST_F(ListsOfImages, OfEurocMayHaveExponents) {
  WriteEuroc(folder_ / "mav0", 1);
  WriteText(folder_ / "mav0/cam0/data.csv",
            "timestamp,filename\n1.403636579763555584e+18,1403636579763555584.png\n");
  EXPECT_EQ(ListImages(folder_ / "mav0").images[0].time_ns, 1403636579763555584);
}

TEST_F(ListsOfImages, CannotNameFilesOutsideOfTheDataset) {
  WriteImage(folder_ / "secret.png", TinyImage(1));
  for (const std::string& name : {std::string("../secret.png"), std::string("rgb/../../secret.png"),
                                  (folder_ / "secret.png").string()}) {
    EXPECT_THAT(ErrorOf([&] { ListWith(time_ + " " + name + "\n"); }),
                AllOf(HasSubstr("rgb.txt:1: "), HasSubstr(name), HasSubstr("inside")));
    WriteEuroc(folder_ / "mav0", 1);
    WriteText(folder_ / "mav0/cam0/data.csv", "1403636579763555584," + name + "\n");
    EXPECT_THAT(ErrorOf([&] { ListImages(folder_ / "mav0"); }),
                AllOf(HasSubstr("data.csv:1: "), HasSubstr(name), HasSubstr("inside")));
  }
  EXPECT_EQ(ListWith(time_ + " rgb/../" + file_ + "\n").images.size(), 1u);
}

TEST_F(ListsOfImages, OnlySelectedFilesAreLookedAt) {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("{} {}\n", i, i < 2 ? file_ : "rgb/none.png");
  }
  WriteText(tum_ / "rgb.txt", text);
  const Selection two{0, 1, 2}, three{0, 1, 3}, last{999, 1, {}};
  EXPECT_EQ(OpenImages(tum_, {}, two).size(), 2);
  ImageSource source = OpenImages(tum_, {}, three);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(source.Next()->missing, Reason::kNone);
  const std::optional<TimedImage> absent = source.Next();
  EXPECT_EQ(absent->missing, Reason::kUnreadableImage);
  EXPECT_THAT(absent->error, HasSubstr("none.png"));
  ImageSource strict = OpenImages(tum_, {}, three);
  strict.RequireAll();
  EXPECT_THAT(ErrorOf([&] {
                while (strict.Next()) continue;
              }),
              HasSubstr("none.png"));
  EXPECT_THAT(ErrorOf([&] { OpenImages(tum_, {}, last).First(); }), HasSubstr("none.png"));
}

/// A trajectory along a curve at 10 Hz, in any format.
std::string Trajectory(const std::string& separator, double shift_s,
                       const std::function<std::string(double)>& time) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.1 * i, u = t + shift_s;
    const std::vector<double> pose = {
        std::sin(0.9 * u) + 0.2 * u, std::cos(0.7 * u), 0.5 * std::sin(1.3 * u), 0, 0, 0, 1};
    text += fmt::format("{}{}{}\n", time(t), separator, fmt::join(pose, separator));
  }
  return text;
}

std::string UnixSeconds(double t) { return fmt::format("{:.3f}", 1.4e9 + t); }

class EvaluatedTexts : public testing::Test {
 protected:
  EvaluatedTexts() { WriteText(truth_, Trajectory(" ", 0, UnixSeconds)); }

  CommandResult Evaluate(const std::string& estimate,
                         std::vector<std::string> arguments = {}) const {
    WriteText(estimate_, estimate);
    arguments.insert(arguments.begin(), {"eval", estimate_, truth_});
    return RunCorvo(arguments);
  }

  TemporaryFolder folder_;
  fs::path truth_ = folder_ / "truth.txt";
  fs::path estimate_ = folder_ / "estimate.txt";
};

TEST_F(EvaluatedTexts, HoldTheSamePosesInEveryForm) {
  const std::string plain = Evaluate(Trajectory(" ", 0, UnixSeconds)).out;
  EXPECT_THAT(plain, HasSubstr("100 pairs"));
  const auto ns = [](double t) { return fmt::format("{:.0f}", 1e3 * (1.4e9 + t)) + "000000"; };
  for (const std::string& text :
       {"\xEF\xBB\xBFtimestamp x y z qx qy qz qw\n" + Trajectory("\t", 0, UnixSeconds),
        Trajectory(",", 0, UnixSeconds), Trajectory("; ", 0, UnixSeconds),
        Trajectory(" ", 0, ns)}) {
    const CommandResult result = Evaluate(text);
    EXPECT_EQ(result.out, plain) << text.substr(0, 80) << result.err;
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(EvaluatedTexts, MayComeFromPipes) {
  const std::string plain = Evaluate(Trajectory(" ", 0, UnixSeconds)).out;
  const std::string script = std::string(CORVO_COMMAND) + " eval <(cat '" + estimate_.string() +
                             "') <(cat '" + truth_.string() + "')";
  const CommandResult result = RunProgram("/bin/bash", {"-c", script}, {"PATH=/usr/bin:/bin"});
  EXPECT_EQ(result.out, plain) << result.err;
}

TEST_F(EvaluatedTexts, OfKittiMustHaveTheSameNumberOfRows) {
  std::string rows;
  for (int i = 0; i < 12; ++i) rows += fmt::format("1 0 0 {} 0 1 0 {} 0 0 1 0\n", i, i % 3);
  WriteText(truth_, rows);
  const CommandResult result = Evaluate(rows.substr(0, rows.find("1 0 0 10 ")));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("10 poses"), HasSubstr("12 in")));
}

TEST_F(EvaluatedTexts, ReportAnOffsetOfTheTimesAndCorrectIt) {
  const auto ate = [](const CommandResult& result) {
    return nlohmann::json::parse(result.out, nullptr, false)["ate"]["rmse"].get<double>();
  };
  const std::string late = Trajectory(" ", 0.4, UnixSeconds);
  const CommandResult wrong = Evaluate(late, {"--json"});
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("corvo: warning: "), HasSubstr("--time-offset 0.4")));
  const CommandResult right = Evaluate(late, {"--json", "--time-offset", "0.4"});
  EXPECT_EQ(right.err, "");
  EXPECT_LT(ate(right), 0.05 * ate(wrong));
  const CommandResult none =
      Evaluate(Trajectory(" ", 0, [](double t) { return fmt::format("{:.3f}", t); }));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err,
              AllOf(HasSubstr("--time-offset 1400000000.0"), HasSubstr("starts at 0.000")));
}

TEST_F(EvaluatedTexts, WithHugeNumbersAreErrorsThatNameTheLine) {
  std::string text = Trajectory(" ", 0, UnixSeconds);
  text += "1400000100 1e160 0 0 0 0 0 1\n";
  const CommandResult result = Evaluate(text, {"--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("estimate.txt:101: "), HasSubstr("x is 1e+160")));
}

TEST_F(EvaluatedTexts, GiveNoNumbersThatAreNone) {
  WriteText(truth_, "0 1 1 1 0 0 0 1\n1 1 1 1 0 0 0 1\n2 1 1 1 0 0 0 1\n");
  const CommandResult result = Evaluate("0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 1 0 0 0 0 1\n",
                                        {"--json", "--align", "none"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(Not(HasSubstr("null")), Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(Videos, ThatCannotBeDecodedAreOneLineWithTheFilesName) {
  const TemporaryFolder folder;
  WriteText(folder / "cut.mp4", std::string("\0\0\0\x18"
                                            "ftypmp42\0\0\0\0mp42isom",
                                            24) +
                                    "xxxx");
  const CommandResult result =
      RunCorvo({"run", folder / "cut.mp4", "--fov", "70", "-o", folder / "out"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::StartsWith("corvo: error: "));
  EXPECT_THAT(result.err, AllOf(HasSubstr("cut.mp4: neither"), Not(HasSubstr("0x"))));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

}  // namespace
}  // namespace corvo::test
