// SPDX-License-Identifier: MIT
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/cli/command.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Returns what readelf (binutils, which every compiler needs) writes about a program or library.
std::string ReadElf(const std::string& option, const std::string& file = CORVO_COMMAND) {
  const CommandResult result = RunProgram("/usr/bin/env", {"readelf", "-W", option, file},
                                          {"PATH=/usr/local/bin:/usr/bin:/bin", "LC_ALL=C"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

/// Returns the functions that the command itself imports, without their versions.
std::set<std::string> ImportedFunctions() {
  std::set<std::string> names;
  std::istringstream lines(ReadElf("--dyn-syms"));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" UND ") == std::string::npos) continue;
    const std::string name = line.substr(line.find(" UND ") + 5);
    names.insert(name.substr(0, name.find_first_of("@ ")));
  }
  return names;
}

/// A server on this machine to which nobody should connect.
class Server {
 public:
  Server() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    is_listening_ = ::bind(socket_, generic, size) == 0 && ::listen(socket_, 8) == 0 &&
                    ::getsockname(socket_, generic, &size) == 0;
    port_ = ntohs(address.sin_port);
  }
  ~Server() { ::close(socket_); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  bool is_listening() const { return is_listening_; }
  int port() const { return port_; }
  bool HasVisitor() const {
    pollfd waiting{socket_, POLLIN, 0};
    return ::poll(&waiting, 1, 0) != 0;
  }

 private:
  int socket_;
  int port_ = 0;
  bool is_listening_ = false;
};

TEST(Hardening, TheCommandIsPositionIndependentAndItsRelocationsReadOnly) {
  if (!CORVO_IS_HARDENED) GTEST_SKIP() << "this build is not hardened";
  EXPECT_THAT(ReadElf("--file-header"), HasSubstr("DYN "));
  const std::string segments = ReadElf("--program-headers");
  EXPECT_THAT(segments, HasSubstr("GNU_RELRO"));
  const std::string stack = segments.substr(segments.find("GNU_STACK"));
  EXPECT_THAT(stack.substr(0, stack.find('\n')), Not(HasSubstr("RWE")));
  EXPECT_THAT(ReadElf("--dynamic"), HasSubstr("BIND_NOW"));
}

TEST(Hardening, TheLibraryChecksItsStackAndCallsOfTheStandardLibrary) {
  if (!CORVO_IS_HARDENED) GTEST_SKIP() << "this build is not hardened";
  EXPECT_THAT(ReadElf("--symbols", CORVO_LIBRARY), HasSubstr("__stack_chk_fail"));
#ifdef NDEBUG                     // Checked calls need optimization.
  EXPECT_GE(_FORTIFY_SOURCE, 2);  // The flags of this file are those of the library.
#endif
}

TEST(Hardening, TheCommandItselfUsesNoNetworkAndNoShell) {
  const std::set<std::string> imported = ImportedFunctions();
  ASSERT_THAT(imported, Not(IsEmpty()));
  for (const char* name : {"socket", "connect", "bind", "listen", "accept", "send", "sendto",
                           "recv", "recvfrom", "getaddrinfo", "gethostbyname", "system", "popen"}) {
    EXPECT_THAT(imported, Not(Contains(name)));
  }
}

TEST(Hardening, APlaylistGivenAsAVideoDoesNotReachTheNetwork) {
  const Server server;
  if (!server.is_listening()) GTEST_SKIP() << "no server can be started here";
  const TemporaryFolder folder;
  const std::string url = fmt::format("http://127.0.0.1:{}/a.ts", server.port());
  const auto video = folder.Write(
      "video.mp4",
      fmt::format("#EXTM3U\n#EXT-X-TARGETDURATION:9\n#EXTINF:9,\n{}\n#EXT-X-ENDLIST\n", url));
  const auto camera = folder.Write("camera.yaml",
                                   "model: pinhole-radtan\nwidth: 96\nheight: 64\n"
                                   "fx: 80\nfy: 80\ncx: 47.5\ncy: 31.5\n");
  for (const std::string& input : {video.string(), url}) {
    const CommandResult result =
        RunCorvo({"run", input, "--camera", camera.string(), "-o", (folder.path() / "o").string()});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_FALSE(server.HasVisitor()) << input;
  }
}

}  // namespace
}  // namespace corvo::test
