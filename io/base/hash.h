// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// SHA-256 (OpenSSL) of texts, files and numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace sunload {

/// Lower-case hexadecimal SHA-256.
std::string sha256(const std::string& bytes);
/// Of a file's bytes; throws InputError where it cannot be read.
std::string sha256_of_file(const std::string& path);

/// SHA-256 of what is added, piece by piece: nothing of it is kept.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(const void* bytes, std::size_t count);
  /// Lower-case; once, at the end.
  std::string hexadecimal();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether equal values have equal bytes: no padding, no pointers. Others say so here.
template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                                 (std::is_trivially_copyable_v<T> &&
                                  std::has_unique_object_representations_v<T>);

/// Values to be hashed: numbers as they lie in memory, texts and lists with their length.
class Digest {
 public:
  template <class Number>
  void add(const Number& number) {
    static_assert(is_plain<Number>);
    hash_.add(&number, sizeof(number));
  }
  void add(const std::string& text) {
    add(text.size());
    hash_.add(text.data(), text.size());
  }
  void add(const std::vector<std::string>& texts) {
    add(texts.size());
    for (const std::string& text : texts) add(text);
  }
  template <class Number>
  void add(const std::vector<Number>& numbers) {
    static_assert(is_plain<Number> && !std::is_same_v<Number, bool>);
    add(numbers.size());
    hash_.add(numbers.data(), numbers.size() * sizeof(Number));
  }
  /// Once, at the end.
  std::string hex() { return hash_.hexadecimal(); }

 private:
  Sha256 hash_;
};

}  // namespace sunload
