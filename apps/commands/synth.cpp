// SPDX-License-Identifier: MIT
#include "apps/commands/synth.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/named_camera.h"
#include "apps/output/printable.h"
#include "apps/run/number_option.h"
#include "apps/synthetic/sequence.h"
#include "apps/synthetic/writer.h"
#include "apps/system/interruption.h"
#include "apps/system/terminal.h"
#include "orb/error.h"

namespace corvo {
namespace {

struct SynthArguments {
  synthetic::Sequence (*make)(const synthetic::SequenceOptions&) = nullptr;
  synthetic::SequenceOptions options;
  std::filesystem::path camera;
  std::string layout = "tum";
  std::string folder;
  bool force = false;
};

synthetic::Layout ParseLayout(const std::string& name) {
  if (name == "kitti") return synthetic::Layout::kKitti;
  return name == "euroc" ? synthetic::Layout::kEuroc : synthetic::Layout::kTum;
}

/// Reads the camera of images that are yet to be made.
CameraParameters ReadSizedCamera(const std::filesystem::path& named) {
  const StatedCamera camera = ReadNamedCamera(named).camera;
  if (camera.has_size()) return camera.parameters;
  throw Error(fmt::format("{}: states no image size; give a camera file with width and height",
                          named.string()));
}

int Synthesize(SynthArguments& arguments) {
  if (!arguments.camera.empty()) arguments.options.camera = ReadSizedCamera(arguments.camera);
  const synthetic::Sequence sequence = arguments.make(arguments.options);
  const bool terminal = IsStandardErrorATerminal();
  const synthetic::Layout layout = ParseLayout(arguments.layout);
  const Interruption interruption;
  try {
    synthetic::WriteSequence(sequence, arguments.folder, layout, arguments.force, [&](int done) {
      if (terminal) fmt::print(stderr, "\r{}/{}", done, sequence.size());
      interruption.ThrowIfRequested();
    });
  } catch (const Interrupted&) {
    // A folder that --force took over may hold other images.
    if (!arguments.force) synthetic::RemoveSequence(arguments.folder);
    spdlog::error("interrupted; the images written so far were {}",
                  arguments.force ? "kept" : "removed");
    return ExitCodeOf(interruption.PendingSignal());
  }
  fmt::print(stderr, "{}{} frames of {} in {}\n", terminal ? "\r" : "", sequence.size(),
             sequence.name(), Printable(arguments.folder));
  return 0;
}

/// Adds an option that takes START,DURATION in seconds.
void AddSpan(CLI::App& command, const char* name, synthetic::TimeSpan& span, const char* meaning) {
  const auto assign = [&span](const std::pair<double, double>& value) {
    span = {value.first, value.second};
  };
  command.add_option_function<std::pair<double, double>>(name, assign, meaning)
      ->check(NumberRange(0, 1e6))
      ->delimiter(',')
      ->type_name("START,DURATION");
}

void AddEffects(CLI::App& command, synthetic::Effects& effects) {
  AddSpan(command, "--dark", effects.dark, "time span of near darkness, s");
  AddSpan(command, "--blur", effects.blur, "time span of motion blur, s");
  command
      .add_option("--drift", effects.exposure_drift,
                  "amplitude of an exposure oscillation with a period of 8 s, stops (0 to 3)")
      ->check(NumberRange(0, 3));
  command
      .add_option("--vignetting", effects.vignetting,
                  "fraction of the light that is lost in the corners (0 to 0.95)")
      ->check(NumberRange(0, 0.95));
  command
      .add_option("--moving", effects.moving_share,
                  "fraction of the image covered by moving objects (0 to 0.8)")
      ->check(NumberRange(0, 0.8));
}

void AddScene(CLI::App& synth, const char* name, const char* description,
              synthetic::Sequence (*make)(const synthetic::SequenceOptions&), int& exit_code) {
  CLI::App* command = synth.add_subcommand(name, description);
  const auto arguments = std::make_shared<SynthArguments>();
  arguments->make = make;
  command->add_option("-o,--output", arguments->folder, "folder to write")->required();
  command
      ->add_option("--layout", arguments->layout,
                   "dataset layout of the files: TUM RGB-D, KITTI or EuRoC")
      ->check(CLI::IsMember({"tum", "kitti", "euroc"}))
      ->capture_default_str();
  command->add_option("--frames", arguments->options.frames, "number of images")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option(
      "--width", arguments->options.width,
      "width of the images, px; height and focal length scale with it (default: the "
      "scene's own)");
  command->add_option(
      "--camera", arguments->camera,
      "calibration file as for 'corvo run', with an image size, or name of a shipped "
      "camera; replaces the scene's own camera");
  command
      ->add_option("--noise", arguments->options.noise_sigma,
                   "standard deviation of the pixel noise, gray levels")
      ->check(NumberRange(0, 100));
  command->add_option("--seed", arguments->options.noise_seed, "random seed of the noise")
      ->capture_default_str();
  AddSpan(*command, "--turn", arguments->options.turn,
          "time span in which the camera stops and rotates 40 degrees to either side, s");
  AddEffects(*command, arguments->options.effects);
  command->add_flag("--force", arguments->force, "overwrite files in a folder that is not empty");
  command->callback([arguments, &exit_code] { exit_code = Synthesize(*arguments); });
}

}  // namespace

void AddSynthCommand(CLI::App& app, int& exit_code) {
  CLI::App* synth = app.add_subcommand("synth", "Render a sequence with exact ground truth");
  synth->require_subcommand(1);
  synth->footer(
      "Examples:\n"
      "  corvo synth room -o room\n"
      "  corvo synth street -o street --layout kitti --frames 200\n"
      "  corvo synth room -o dark --dark 4,2 --noise 2 --seed 7\n"
      "  corvo synth corridor -o crowd --layout euroc --moving 0.2 --drift 1 --vignetting 0.5\n"
      "  corvo synth room -o fisheye --camera configs/tumvi.yaml\n\n"
      "'corvo synth SCENE --help' shows the options.");
  AddScene(*synth, "room", "a walk round a furnished room, about 8 m", synthetic::MakeRoom,
           exit_code);
  AddScene(*synth, "street", "a drive along a street with bends", synthetic::MakeStreet, exit_code);
  AddScene(*synth, "corridor", "a walk down a corridor with little texture",
           synthetic::MakeCorridor, exit_code);
  AddScene(*synth, "wall", "a camera in front of a plane", synthetic::MakePlanarWall, exit_code);
  AddScene(*synth, "rotation", "a camera that rotates without translating",
           synthetic::MakePureRotation, exit_code);
}

}  // namespace corvo
