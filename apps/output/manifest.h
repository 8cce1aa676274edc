// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// The name of the manifest of a result folder.
inline constexpr const char* kManifestName = "manifest.json";

/// A file of a result, as it was written.
struct ManifestFile {
  std::string name;  ///< Name in the folder of the manifest.
  std::uintmax_t num_bytes = 0;
  std::uint32_t crc32 = 0;

  bool operator==(const ManifestFile&) const = default;
};

/// The files of a result. A file belongs to corvo only if a manifest beside it lists it and it has
/// not been changed since.
struct Manifest {
  bool is_complete = true;  ///< Whether the result is that of a run that reached its end.
  std::vector<ManifestFile> files;

  const ManifestFile* Find(std::string_view name) const;
};

/// Returns the CRC-32 (IEEE 802.3) of a text, continuing that of the text before it.
std::uint32_t Crc32(std::string_view text, std::uint32_t before = 0);

/// Returns the size and checksum of a file. Throws corvo::Error if it cannot be read.
ManifestFile Describe(const std::filesystem::path& file);

/// Returns whether `file` is a regular file, not a link, with the size and checksum of `expected`.
bool IsUnchanged(const std::filesystem::path& file, const ManifestFile& expected);

std::string ToText(const Manifest& manifest);

/// Returns std::nullopt if there is no such file or if it is not a manifest of corvo. Throws
/// corvo::Error or std::filesystem::filesystem_error if it cannot be read.
std::optional<Manifest> ReadManifest(const std::filesystem::path& file);

/// Returns the files that the manifests in a folder list, whether or not they exist.
std::vector<ManifestFile> ListResults(const std::filesystem::path& folder);

}  // namespace corvo
