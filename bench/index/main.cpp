// SPDX-License-Identifier: MIT
// This program compares an index of descriptors with the exact scan: see kHelp.

#include <exception>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/output/environment.h"
#include "bench/clocks.h"
#include "bench/index/collection.h"
#include "bench/index/measurement.h"
#include "orb/error.h"

namespace corvo::bench {
namespace {

constexpr const char* kHelp =
    "Measures corvo's index of descriptors against its exact scan, on descriptors of images in\n"
    "the folder that CORVO_DATA names; queries are some of them with 25 to 50 bits flipped. Then\n"
    "both at the sizes of the relocaliser. Prints tables and writes everything as JSON. Times are\n"
    "processor time of one thread, the least of a number of repeats.";

struct Arguments {
  std::string json;
  int size = 1200000;
  int num_queries = 1000;
  int repeats = 5;
};

using Json = nlohmann::ordered_json;

std::vector<orb::Nearest> ReportScans(const Collection& collection,
                                      const std::vector<orb::Descriptor>& queries,
                                      const Arguments& args, Json& json) {
  fmt::print("| exact scan | ms a query | MB |\n|---|---|---|\n");
  std::vector<orb::Nearest> exact;
  for (const int batch : {64, 1}) {
    const ScanResult scan = MeasureScan(collection.descriptors, queries, batch, args.repeats);
    fmt::print("| batches of {} | {:.3f} | {:.1f} |\n", batch, scan.query_ms, scan.memory_mb);
    json["scans"].push_back(
        {{"batch", batch}, {"query_ms", scan.query_ms}, {"memory_mb", scan.memory_mb}});
    exact = scan.nearest;
  }
  return exact;
}

void ReportIndices(const Collection& collection, const std::vector<orb::Descriptor>& queries,
                   const std::vector<orb::Nearest>& exact, const Arguments& args, Json& json) {
  fmt::print(
      "\n| tables | flips | recall asked | recall@1 | ms a query, mean | median | p99 | MB "
      "| built in, s |\n|---|---|---|---|---|---|---|---|---|\n");
  const orb::LshIndexOptions standard;
  const orb::LshIndexOptions variants[] = {
      standard,         {.num_tables = 6}, {.num_tables = 10},
      {.max_flips = 1}, {.recall = 0.9},   {.max_flips = 3, .recall = 0.99},
  };
  for (const orb::LshIndexOptions& options : variants) {
    const IndexResult result =
        MeasureIndex(collection.descriptors, queries, exact, options, args.repeats);
    fmt::print("| {}{} | {} | {} | {:.3f} | {:.4f} | {:.4f} | {:.4f} | {:.1f} | {:.2f} |\n",
               options.num_tables, options == standard ? " (default)" : "", options.max_flips,
               options.recall, result.recall, result.mean_ms, result.p50_ms, result.p99_ms,
               result.memory_mb, result.build_s);
    json["indices"].push_back({{"num_tables", options.num_tables},
                               {"max_flips", options.max_flips},
                               {"recall", options.recall},
                               {"recall_at_1", result.recall},
                               {"mean_ms", result.mean_ms},
                               {"p50_ms", result.p50_ms},
                               {"p99_ms", result.p99_ms},
                               {"memory_mb", result.memory_mb},
                               {"build_s", result.build_s}});
  }
}

/// Measures queries of all keypoints of a frame at once, like those of the relocalizer: flipped
/// copies, which suit the index best, and descriptors of other images, which have no match in it.
void ReportRelocaliserSizes(const Collection& collection, const Arguments& args, Json& json) {
  fmt::print(
      "\n| 2000 queries among | queries | exact scan, ms | index, ms | index and its making, "
      "ms | recall@1 |\n|---|---|---|---|---|---|\n");
  constexpr int kQueries = 2000;
  const std::span<const orb::Descriptor> all(collection.descriptors);
  for (const int size : {5000, 20000, 50000, 200000}) {
    if (size + kQueries > static_cast<int>(all.size())) break;
    const auto landmarks = all.first(size);
    const std::vector<orb::Descriptor> known(landmarks.begin(), landmarks.end());
    const auto flipped = MakeQueries(known, kQueries, 3);
    for (const bool is_known : {true, false}) {
      const std::span<const orb::Descriptor> queries =
          is_known ? std::span<const orb::Descriptor>(flipped) : all.last(kQueries);
      const ScanResult scan = MeasureScan(landmarks, queries, kQueries, args.repeats);
      const IndexResult index =
          MeasureIndex(landmarks, queries, scan.nearest, orb::LshIndexOptions(), args.repeats);
      const double scan_ms = kQueries * scan.query_ms, index_ms = kQueries * index.mean_ms;
      const char* kind = is_known ? "flipped copies" : "of other images";
      fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.3f} |\n", size, kind, scan_ms, index_ms,
                 index_ms + 1e3 * index.build_s, index.recall);
      json["relocaliser"].push_back({{"landmarks", size},
                                     {"queries", kind},
                                     {"scan_ms", scan_ms},
                                     {"index_ms", index_ms},
                                     {"build_ms", 1e3 * index.build_s},
                                     {"recall_at_1", index.recall}});
    }
  }
}

int Main(int argc, char** argv) {
  Arguments args;
  CLI::App app(kHelp);
  app.add_option("--json", args.json, "File for every figure");
  app.add_option("--size", args.size, "Descriptors")->check(CLI::Range(10000, 100000000));
  app.add_option("--queries", args.num_queries, "Queries")->check(CLI::Range(1, 1000000));
  app.add_option("--repeats", args.repeats, "Of every measurement")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  const Collection collection = MakeCollection(args.size);
  const auto queries = MakeQueries(collection.descriptors, args.num_queries, 1);
  Json json = {{"environment", DescribeMachine()},
               {"descriptors", args.size},
               {"of_images", collection.num_real},
               {"images", collection.num_images},
               {"queries", args.num_queries}};
  fmt::print("{} descriptors, {} of them of {} images; {} queries\n\n", args.size,
             collection.num_real, collection.num_images, args.num_queries);
  const std::vector<orb::Nearest> exact = ReportScans(collection, queries, args, json);
  ReportIndices(collection, queries, exact, args, json);
  const FileResult file = MeasureFile(collection.descriptors);
  fmt::print("\nfile: {:.1f} MB, saved in {:.2f} s, loaded in {:.2f} s\n", file.size_mb,
             file.save_s, file.load_s);
  json["file"] = {{"size_mb", file.size_mb}, {"save_s", file.save_s}, {"load_s", file.load_s}};
  ReportRelocaliserSizes(collection, args, json);
  if (args.json.empty()) return 0;
  std::ofstream stream(args.json);
  stream << json.dump(1) << "\n";
  stream.close();
  if (!stream) throw Error(args.json + ": cannot be written");
  return 0;
}

}  // namespace
}  // namespace corvo::bench

int main(int argc, char** argv) {
  try {
    return corvo::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corvo_index_bench: {}\n", error.what());
    return 1;
  }
}
