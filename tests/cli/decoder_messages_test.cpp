// SPDX-License-Identifier: MIT
#include "apps/system/decoder_messages.h"

#include <cstdio>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

namespace corvo {
namespace {

TEST(DecoderMessages, AreCaughtUntilTheEndOfTheObject) {
  testing::internal::CaptureStderr();
  {
    DecoderMessages messages;
    EXPECT_EQ(messages.Take(), "");
    std::fputs("first [h264 @ 0x55cd1914a580] line\nsecond line\n", stderr);
    EXPECT_EQ(messages.Take(), "first [h264] line");
    EXPECT_EQ(messages.Take(), "");
    std::fputs("not asked for\n", stderr);
  }
  std::fputs("shown\n", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "shown\n");
}

TEST(DecoderMessages, DoNotContainThoseOfTheProgramItself) {
  testing::internal::CaptureStderr();
  std::thread printing;
  {
    DecoderMessages messages;
    printing = std::thread([] {
      const std::scoped_lock lock(MessageLock::mutex());
      std::fputs("shown\n", stderr);
    });
    EXPECT_EQ(messages.Take(), "");
  }
  printing.join();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "shown\n");
}

}  // namespace
}  // namespace corvo
