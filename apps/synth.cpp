#include "apps/synth.h"

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "apps/synthetic/sequence.h"
#include "apps/synthetic/writer.h"

namespace corvo {
namespace {

struct SynthArguments {
  synthetic::Sequence (*make)(const synthetic::SequenceOptions&) = nullptr;
  synthetic::SequenceOptions options;
  std::string layout = "tum";
  std::string folder;
  bool force = false;
};

void Synthesise(const SynthArguments& arguments) {
  const synthetic::Sequence sequence = arguments.make(arguments.options);
  const bool terminal = isatty(fileno(stderr)) != 0;
  const synthetic::Layout layout =
      arguments.layout == "kitti" ? synthetic::Layout::kKitti : synthetic::Layout::kTum;
  synthetic::WriteSequence(sequence, arguments.folder, layout, arguments.force, [&](int done) {
    if (terminal) fmt::print(stderr, "\r{}/{}", done, sequence.size());
  });
  fmt::print(stderr, "{}{} frames of {} in {}\n", terminal ? "\r" : "", sequence.size(),
             sequence.name(), arguments.folder);
}

void AddScene(CLI::App& synth, const char* name, const char* description,
              synthetic::Sequence (*make)(const synthetic::SequenceOptions&)) {
  CLI::App* command = synth.add_subcommand(name, description);
  const auto arguments = std::make_shared<SynthArguments>();
  arguments->make = make;
  command->add_option("-o,--output", arguments->folder, "folder to write")->required();
  command->add_option("--layout", arguments->layout, "of the files: TUM RGB-D or KITTI odometry")
      ->check(CLI::IsMember({"tum", "kitti"}))
      ->capture_default_str();
  command->add_option("--frames", arguments->options.frames, "number of pictures")
      ->capture_default_str();
  command->add_option("--width", arguments->options.width,
                      "width of the pictures, px; the rest follows (default: the scene's own)");
  command->add_option("--noise", arguments->options.noise_sigma,
                      "standard deviation of the noise in each pixel, grey levels");
  command->add_flag("--force", arguments->force, "overwrite files in a folder that is not empty");
  command->callback([arguments] { Synthesise(*arguments); });
}

}  // namespace

void AddSynthCommand(CLI::App& app) {
  CLI::App* synth = app.add_subcommand("synth", "Render a sequence with exact ground truth");
  synth->require_subcommand(1);
  synth->footer(
      "Examples:\n"
      "  corvo synth room -o room\n"
      "  corvo synth street -o street --layout kitti --frames 200");
  AddScene(*synth, "room", "a walk round a furnished room, about 8 m", synthetic::MakeRoom);
  AddScene(*synth, "street", "a drive along a street with bends", synthetic::MakeStreet);
  AddScene(*synth, "wall", "a camera before a plane", synthetic::MakePlanarWall);
  AddScene(*synth, "rotation", "a camera that turns and does not move",
           synthetic::MakePureRotation);
}

}  // namespace corvo
