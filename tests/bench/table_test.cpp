// SPDX-License-Identifier: MIT
#include "bench/table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace corvo::bench {
namespace {

const std::vector<ComparisonRow> kRows = {
    {"features", "street", "AVX3", 2.0, 2.2, 10.0, 4.96},
    {"corners", "room", "AVX3", 0.5, 0.75, 1234.0, 2.0},
    {"features", "street", "AVX2", 3.0, 3.1, 10.0, 3.333},
};

TEST(ComparisonTableTest, HasALineForEachTitleAndAColumnForEachInstructionSet) {
  EXPECT_EQ(ComparisonTable(kRows, {"AVX3", "AVX2", "SSE4"}),
            "| comparison | images | ms | p99 / p50 | baseline ms | AVX3 | AVX2 |\n"
            "|---|---|---|---|---|---|---|\n"
            "| features | street | 2 | 1.10 | 10 | 4.96x | 3.33x |\n"
            "| corners | room | 0.5 | 1.50 | 1.23e+03 | 2.00x | |\n");
}

TEST(ComparisonTableTest, OrdersTheColumnsAsGiven) {
  const std::string table = ComparisonTable(kRows, {"AVX2", "AVX3"});
  EXPECT_NE(table.find("| features | street | 2 | 1.10 | 10 | 3.33x | 4.96x |\n"),
            std::string::npos);
}

TEST(StageTableTest, HasALineForEachRowAndAColumnForEachStage) {
  const std::vector<StageRow> rows = {{"features", "street", {1.25, 0.5}}};
  EXPECT_EQ(StageTable(rows, {"pyramid", "FAST"}),
            "| stages, ms | images | pyramid | FAST |\n"
            "|---|---|---|---|\n"
            "| features | street | 1.25 | 0.5 |\n");
}

}  // namespace
}  // namespace corvo::bench
