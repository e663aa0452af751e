// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/hash.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "geo/base/check.h"

namespace sunload {
namespace {

constexpr std::size_t bytes_per_read = 1 << 20;  // per read: large against the cost of a call

}  // namespace

struct Sha256::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(),
                                                                  &EVP_MD_CTX_free};
  // Numbers come one by one: they are handed on together.
  std::array<unsigned char, 4096> waiting{};
  std::size_t waiting_count = 0;

  void update(const void* bytes, std::size_t count) {
    SUNLOAD_EXPECT(EVP_DigestUpdate(context.get(), bytes, count) == 1, "SHA-256 of OpenSSL");
  }
  void flush() {
    update(waiting.data(), waiting_count);
    waiting_count = 0;
  }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  SUNLOAD_EXPECT(
      state_->context && EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr) == 1,
      "SHA-256 of OpenSSL");
}

Sha256::~Sha256() = default;

void Sha256::add(const void* bytes, std::size_t count) {
  State& state = *state_;
  if (count > state.waiting.size() - state.waiting_count) state.flush();
  if (count > state.waiting.size()) return state.update(bytes, count);
  if (count == 0) return;
  std::memcpy(state.waiting.data() + state.waiting_count, bytes, count);
  state.waiting_count += count;
}

std::string Sha256::hexadecimal() {
  state_->flush();
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  SUNLOAD_EXPECT(EVP_DigestFinal_ex(state_->context.get(), digest.data(), &length) == 1,
                 "SHA-256 of OpenSSL");
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += digits[digest[i] / 16];
    text += digits[digest[i] % 16];
  }
  return text;
}

std::string sha256(const std::string& bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hexadecimal();
}

std::string sha256_of_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string buffer(bytes_per_read, '\0');
  Sha256 hash;
  while (file.good()) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) {  // not opened, a folder, or a failing disk
    throw InputError({path}, "cannot be read", errno != 0 ? std::strerror(errno) : "read error");
  }
  return hash.hexadecimal();
}

}  // namespace sunload
