// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// Writes a file. Throws corvo::Error naming it and the reason if it cannot be written in full.
void WriteFile(const std::filesystem::path& file, std::string_view content);

/// Waits until the disk holds a file or the entries of a folder. Throws corvo::Error if it cannot.
void Flush(const std::filesystem::path& file);

/// Returns the names of the entries of a folder, in no order; empty if it does not exist. Throws
/// corvo::Error if it cannot be read. Unlike std::filesystem::directory_iterator, it does not end
/// the process if memory runs out.
std::vector<std::string> ListNames(const std::filesystem::path& folder);

/// Removes a file, or a folder with all its content; it need not exist. Returns false if something
/// is left. Unlike std::filesystem::remove_all(), it does not end the process if memory runs out.
bool RemoveTree(const std::filesystem::path& path) noexcept;

/// Renames a file or folder, replacing a file or an empty folder. Throws corvo::Error if it cannot.
void Move(const std::filesystem::path& from, const std::filesystem::path& to);

/// Puts the folder `from` in the place of the folder `to`, in one step if `to` does not exist or
/// the file system can exchange folders; an earlier `to` is removed. Throws corvo::Error if it
/// cannot.
void ReplaceFolder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace corvo
