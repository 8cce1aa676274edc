// SPDX-License-Identifier: MIT
#include "orb/pattern_learning.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "orb/error.h"
#include "orb/kernels/bit_columns.h"
#include "orb/workers.h"

namespace corvo::orb {
namespace {

constexpr int kFirstPercent = 20;  // Initial threshold of the correlation.
constexpr int kPercentStep = 5;

int NumWords(int num_bits) { return (num_bits + 63) / 64; }

/// A test, given by the positions of its windows, and the statistics of its bit on the training
/// set.
struct Candidate {
  int p = 0;
  int q = 0;
  int num_ones = 0;   ///< Ones among the first views.
  int num_flips = 0;  ///< Keypoints whose two views have different bits.
};

bool WindowsOverlap(const Offset& p, const Offset& q) {
  return std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)) <= 2 * kWindowRadius;
}

std::vector<Candidate> AllCandidates() {
  std::vector<Candidate> candidates;
  for (int p = 0; p < kNumPositions; ++p) {
    for (int q = p + 1; q < kNumPositions; ++q) {
      if (!WindowsOverlap(PositionAt(p), PositionAt(q))) candidates.push_back({p, q});
    }
  }
  return candidates;
}

/// Counts the ones and flips of candidates over keypoints [begin, end), at most kBlock.
constexpr int kBlock = 1024;
void CountBlock(const TrainingSet& training, int begin, int end, std::span<Candidate> candidates) {
  constexpr std::uint64_t kZeros[kBlock / 64] = {};
  std::uint64_t first[kBlock / 64];
  std::uint64_t second[kBlock / 64];
  const int num_words = NumWords(end - begin);
  for (Candidate& candidate : candidates) {
    kernels::CompareRows(training.first(candidate.p) + begin, training.first(candidate.q) + begin,
                         end - begin, first);
    kernels::CompareRows(training.second(candidate.p) + begin, training.second(candidate.q) + begin,
                         end - begin, second);
    candidate.num_ones += kernels::CountDifferences(first, kZeros, num_words);
    candidate.num_flips += kernels::CountDifferences(first, second, num_words);
  }
}

void CountBits(const TrainingSet& training, Workers& workers, std::vector<Candidate>& candidates) {
  constexpr int kShare = 4096;
  const int num_candidates = static_cast<int>(candidates.size());
  workers.ForEach((num_candidates + kShare - 1) / kShare, [&](int task) {
    const int count = std::min(kShare, num_candidates - task * kShare);
    const std::span<Candidate> share(candidates.data() + task * kShare, count);
    for (int begin = 0; begin < training.size(); begin += kBlock) {
      CountBlock(training, begin, std::min(begin + kBlock, training.size()), share);
    }
  });
}

/// Returns the merit d' of a candidate (see LearnPattern()).
double Merit(const Candidate& candidate, int size) {
  const double mean = static_cast<double>(candidate.num_ones) / size;
  const double flipping = static_cast<double>(candidate.num_flips) / size;
  const double differing = 2 * mean * (1 - mean);
  return (differing - flipping) /
         std::sqrt(differing * (1 - differing) + flipping * (1 - flipping));
}

/// Returns the candidates whose bit varies, best first; ties keep their order.
std::vector<Candidate> RankCandidates(const std::vector<Candidate>& candidates, int size) {
  std::vector<std::pair<double, Candidate>> ranked;
  for (const Candidate& candidate : candidates) {
    const bool varies = candidate.num_ones > 0 && candidate.num_ones < size;
    if (varies) ranked.emplace_back(Merit(candidate, size), candidate);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Candidate> sorted;
  sorted.reserve(ranked.size());
  for (const auto& [merit, candidate] : ranked) sorted.push_back(candidate);
  return sorted;
}

/// The bits of a candidate over all first views.
struct Column {
  Candidate candidate;
  std::vector<std::uint64_t> words;
};

/// Returns the magnitude of the correlation between two columns of `size` bits; both vary.
double Correlation(const Column& a, const Column& b, int size) {
  const std::int64_t ones_a = a.candidate.num_ones;
  const std::int64_t ones_b = b.candidate.num_ones;
  const int num_differing =
      kernels::CountDifferences(a.words.data(), b.words.data(), static_cast<int>(a.words.size()));
  const std::int64_t num_both = (ones_a + ones_b - num_differing) / 2;
  const auto covariance = static_cast<double>(size * num_both - ones_a * ones_b);
  const auto variance_a = static_cast<double>(ones_a * (size - ones_a));
  const auto variance_b = static_cast<double>(ones_b * (size - ones_b));
  return std::abs(covariance) / std::sqrt(variance_a * variance_b);
}

/// The greedy selection at one threshold.
class Selection {
 public:
  Selection(const TrainingSet& training, double max_correlation)
      : training_(training), max_correlation_(max_correlation) {}

  /// Adds the candidates that fit, in order, until there are kNumTests. The workers make the
  /// columns and compare them with the tests chosen in earlier calls; the columns are then compared
  /// with one another in order.
  void Take(std::span<const Candidate> candidates, Workers& workers) {
    const std::size_t num_before = chosen_.size();
    std::vector<Column> columns(candidates.size());
    workers.ForEach(static_cast<int>(candidates.size()), [&](int i) {
      Column column = MakeColumn(candidates[i]);
      if (Fits(column, 0)) columns[i] = std::move(column);
    });
    for (Column& column : columns) {
      if (is_full() || column.words.empty() || !Fits(column, num_before)) continue;
      chosen_.push_back(std::move(column));
    }
  }

  bool is_full() const { return chosen_.size() == kNumTests; }
  const std::vector<Column>& chosen() const { return chosen_; }

 private:
  Column MakeColumn(const Candidate& candidate) const {
    Column column{candidate, std::vector<std::uint64_t>(NumWords(training_.size()))};
    kernels::CompareRows(training_.first(candidate.p), training_.first(candidate.q),
                         training_.size(), column.words.data());
    return column;
  }

  /// Returns whether a column correlates little with the chosen tests from index `begin` on.
  bool Fits(const Column& column, std::size_t begin) const {
    return std::all_of(chosen_.begin() + static_cast<std::ptrdiff_t>(begin), chosen_.end(),
                       [&](const Column& other) {
                         return Correlation(column, other, training_.size()) <= max_correlation_;
                       });
  }

  const TrainingSet& training_;
  double max_correlation_;
  std::vector<Column> chosen_;
};

Selection SelectTests(const TrainingSet& training, std::span<const Candidate> ranked,
                      double max_correlation, Workers& workers,
                      const std::function<void(const SelectionProgress&)>& report) {
  constexpr std::size_t kBatch = 256;
  Selection selection(training, max_correlation);
  for (std::size_t begin = 0; begin < ranked.size() && !selection.is_full(); begin += kBatch) {
    selection.Take(ranked.subspan(begin, std::min(kBatch, ranked.size() - begin)), workers);
    if (!report) continue;
    const double share = static_cast<double>(begin) / static_cast<double>(ranked.size());
    report({max_correlation, static_cast<int>(selection.chosen().size()), share});
  }
  return selection;
}

LearningResult MakeResult(const std::vector<Column>& chosen, double max_correlation, int size) {
  LearningResult result;
  result.max_correlation = max_correlation;
  std::int64_t num_flips = 0;
  for (int i = 0; i < kNumTests; ++i) {
    const Candidate& candidate = chosen[i].candidate;
    result.pattern[i] = {PositionAt(candidate.p), PositionAt(candidate.q)};
    num_flips += candidate.num_flips;
  }
  result.flip_rate = static_cast<double>(num_flips) / (static_cast<double>(size) * kNumTests);
  return result;
}

}  // namespace

TrainingSet::TrainingSet(int capacity)
    : first_(kNumPositions, capacity, CV_16UC1), second_(kNumPositions, capacity, CV_16UC1) {}

void TrainingSet::Add(std::span<const PositionSums> first, std::span<const PositionSums> second) {
  const int count = std::min(static_cast<int>(first.size()), first_.cols - size_);
  for (int position = 0; position < kNumPositions; ++position) {
    auto* first_row = first_.ptr<std::uint16_t>(position) + size_;
    auto* second_row = second_.ptr<std::uint16_t>(position) + size_;
    for (int i = 0; i < count; ++i) {
      first_row[i] = first[i][position];
      second_row[i] = second[i][position];
    }
  }
  size_ += count;
}

LearningResult LearnPattern(const TrainingSet& training, int threads,
                            const std::function<void(const SelectionProgress&)>& report) {
  if (training.size() < kMinTrainingSize) {
    throw Error(std::to_string(training.size()) + " keypoints to learn from; at least " +
                std::to_string(kMinTrainingSize) + " are needed");
  }
  Workers workers(threads);
  std::vector<Candidate> candidates = AllCandidates();
  CountBits(training, workers, candidates);
  const std::vector<Candidate> ranked = RankCandidates(candidates, training.size());
  for (int percent = kFirstPercent; percent <= 100; percent += kPercentStep) {
    const double max_correlation = percent / 100.0;
    const Selection selection = SelectTests(training, ranked, max_correlation, workers, report);
    if (!selection.is_full()) continue;
    return MakeResult(selection.chosen(), max_correlation, training.size());
  }
  throw Error("only " + std::to_string(ranked.size()) + " tests vary between the keypoints; " +
              std::to_string(kNumTests) + " are needed");
}

}  // namespace corvo::orb
