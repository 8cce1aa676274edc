// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace corvo {

/// The fields of a mapping in a document. Errors are corvo::Error and name the field.
class DocumentFields {
 public:
  /// The names of a field in different versions of a tool.
  using Keys = std::initializer_list<const char*>;

  /// `where` precedes the names of fields in messages: "<file>: ", or "<file>: cam0.". A node that
  /// is no mapping has no fields.
  DocumentFields(const YAML::Node& map, std::string where) : map_(map), where_(std::move(where)) {}

  const std::string& where() const { return where_; }

  bool Has(const std::string& key) const { return Find(key).IsDefined(); }
  /// Returns the first of `keys` that the mapping has, or else the first.
  std::string FirstOf(Keys keys) const;

  /// Returns the text of a scalar, or an empty one if the field is left out. Throws for lists and
  /// mappings.
  std::string Text(const std::string& key) const;

  /// Returns a finite number. Throws if the field is left out or anything else.
  double Number(const std::string& key) const;
  /// Returns std::nullopt if the field is left out.
  std::optional<double> FindNumber(const std::string& key) const;

  /// Returns the numbers of a list, of a list of lists, of a matrix as OpenCV or ROS writes it
  /// ("data" of a mapping), or of a text with blanks. Throws if there are fewer than `min` or more
  /// than `max`, or if the field is left out although `min` is not 0.
  std::vector<double> Numbers(const std::string& key, std::size_t min, std::size_t max) const;

  /// Returns the fields of a mapping in this one.
  DocumentFields Section(const std::string& key) const;
  /// Returns the fields of each entry of a list; none if the field is no list.
  std::vector<DocumentFields> Sections(const std::string& key) const;

 private:
  YAML::Node Find(const std::string& key) const;

  YAML::Node map_;
  std::string where_;
};

/// Returns the scalar keys of a mapping, in their order.
std::vector<std::string> KeysOf(const YAML::Node& map);

/// Returns the frame rate that a field states, Hz; std::nullopt if it is left out or 0, which some
/// tools write for an unknown one. Throws corvo::Error if it is out of range.
std::optional<double> StatedFrameRate(const DocumentFields& fields, const std::string& key);

}  // namespace corvo
