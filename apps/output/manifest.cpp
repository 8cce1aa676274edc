// SPDX-License-Identifier: MIT
#include "apps/output/manifest.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/output/json_text.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "corvo result";
constexpr int kVersion = 1;

std::array<std::uint32_t, 256> MakeCrcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ (value & 1 ? 0xEDB88320U : 0U);
    table[byte] = value;
  }
  return table;
}

/// Returns a name in printable ASCII: JSON cannot hold names that are not UTF-8.
std::string EncodeName(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool is_plain = c > ' ' && c < 0x7F && c != '%';
    text += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<std::uint8_t>(c));
  }
  return text;
}

std::string DecodeName(const std::string& text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_code = text[i] == '%' && i + 2 < text.size();
    name += is_code ? static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)) : text[i];
    if (is_code) i += 2;
  }
  return name;
}

/// Returns whether a name stays in the folder of its manifest.
bool IsPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

Manifest FromJson(const nlohmann::json& json) {
  Manifest manifest;
  manifest.is_complete = json.at("complete").get<bool>();
  for (const nlohmann::json& entry : json.at("files")) {
    const auto crc32 = std::stoul(entry.at("crc32").get<std::string>(), nullptr, 16);
    ManifestFile file{DecodeName(entry.at("name").get<std::string>()),
                      entry.at("bytes").get<std::uintmax_t>(), static_cast<std::uint32_t>(crc32)};
    if (!IsPlainName(file.name)) throw Error("not a name");
    manifest.files.push_back(std::move(file));
  }
  return manifest;
}

bool IsManifestName(const std::string& name) {
  return name == kManifestName || (name.starts_with('.') && name.ends_with(".manifest.json"));
}

}  // namespace

const ManifestFile* Manifest::Find(std::string_view name) const {
  const auto found = std::ranges::find(files, name, &ManifestFile::name);
  return found == files.end() ? nullptr : &*found;
}

std::uint32_t Crc32(std::string_view text, std::uint32_t before) {
  static const std::array<std::uint32_t, 256> kTable = MakeCrcTable();
  std::uint32_t crc = ~before;
  for (const char c : text) crc = (crc >> 8) ^ kTable[(crc ^ static_cast<std::uint8_t>(c)) & 0xFF];
  return ~crc;
}

ManifestFile Describe(const fs::path& file) {
  ManifestFile description{file.filename().string(), 0, 0};
  std::ifstream stream(file, std::ios::binary);
  std::string buffer(1 << 16, '\0');
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    description.crc32 = Crc32(std::string_view(buffer.data(), count), description.crc32);
    description.num_bytes += count;
  }
  if (!stream.eof()) throw Error(fmt::format("{}: cannot be read", file.string()));
  return description;
}

bool IsUnchanged(const fs::path& file, const ManifestFile& expected) {
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::regular) return false;
  if (fs::file_size(file, error) != expected.num_bytes || error) return false;
  return Describe(file).crc32 == expected.crc32;
}

std::string ToText(const Manifest& manifest) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const ManifestFile& file : manifest.files) {
    files.push_back({{"name", EncodeName(file.name)},
                     {"bytes", file.num_bytes},
                     {"crc32", fmt::format("{:08x}", file.crc32)}});
  }
  return JsonText({{"format", kFormat},
                   {"version", kVersion},
                   {"complete", manifest.is_complete},
                   {"files", files}});
}

std::optional<Manifest> ReadManifest(const fs::path& file) {
  const fs::file_status status = fs::status(file);
  if (!fs::is_regular_file(status) || fs::file_size(file) > kMaxTextBytes) return std::nullopt;
  const std::string text = ReadFileBytes(file, kMaxTextBytes);
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("format") != kFormat || json.at("version") != kVersion) return std::nullopt;
    return FromJson(json);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // Of another program, or cut off.
    return std::nullopt;
  }
}

std::vector<ManifestFile> ListResults(const fs::path& folder) {
  std::vector<ManifestFile> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!IsManifestName(entry.path().filename().string())) continue;
    const std::optional<Manifest> manifest = ReadManifest(entry.path());
    if (!manifest) continue;
    files.insert(files.end(), manifest->files.begin(), manifest->files.end());
  }
  return files;
}

}  // namespace corvo
