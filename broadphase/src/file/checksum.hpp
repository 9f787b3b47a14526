#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace surehit::detail {

/// XXH64 with seed 0 (Yann Collet), of bytes that come in pieces. It is as fast as memory is read, and it is described
/// in public. It finds damage, but not intent: anyone can make the right one.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes) {
    total_ += bytes.size();
    if (filled_ != 0) {
      const std::size_t taken = std::min(block_size - filled_, bytes.size());
      std::memcpy(block_.data() + filled_, bytes.data(), taken);
      filled_ += taken;
      bytes = bytes.subspan(taken);
      if (filled_ < block_size) return;
      mix(block_.data());
      filled_ = 0;
    }
    for (; bytes.size() >= block_size; bytes = bytes.subspan(block_size)) mix(bytes.data());
    if (bytes.empty()) return;
    filled_ = bytes.size();
    std::memcpy(block_.data(), bytes.data(), filled_);
  }

  /// Returns the checksum of all bytes so far.
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t sum = prime_5;
    if (total_ >= block_size) {
      sum = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
      for (const std::uint64_t lane : lanes_) sum = (sum ^ mixed(0, lane)) * prime_1 + prime_4;
    }
    sum += total_;
    std::size_t at = 0;
    for (; at + 8 <= filled_; at += 8) {
      sum = std::rotl(sum ^ mixed(0, word<std::uint64_t>(&block_[at])), 27) * prime_1 + prime_4;
    }
    if (at + 4 <= filled_) {
      sum = std::rotl(sum ^ word<std::uint32_t>(&block_[at]) * prime_1, 23) * prime_2 + prime_3;
      at += 4;
    }
    for (; at < filled_; ++at)
      sum = std::rotl(sum ^ std::to_integer<std::uint64_t>(block_[at]) * prime_5, 11) * prime_1;
    sum = (sum ^ sum >> 33) * prime_2;
    sum = (sum ^ sum >> 29) * prime_3;
    return sum ^ sum >> 32;
  }

 private:
  static_assert(std::endian::native == std::endian::little);
  static constexpr std::size_t block_size = 32;
  static constexpr std::uint64_t prime_1 = 0x9e3779b185ebca87;
  static constexpr std::uint64_t prime_2 = 0xc2b2ae3d27d4eb4f;
  static constexpr std::uint64_t prime_3 = 0x165667b19e3779f9;
  static constexpr std::uint64_t prime_4 = 0x85ebca77c2b2ae63;
  static constexpr std::uint64_t prime_5 = 0x27d4eb2f165667c5;

  template <typename Word>
  static std::uint64_t word(const std::byte* from) {
    Word word;
    std::memcpy(&word, from, sizeof word);
    return word;
  }
  static std::uint64_t mixed(std::uint64_t lane, std::uint64_t word) {
    return std::rotl(lane + word * prime_2, 31) * prime_1;
  }
  void mix(const std::byte* block) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) lanes_[i] = mixed(lanes_[i], word<std::uint64_t>(block + 8 * i));
  }

  std::array<std::uint64_t, 4> lanes_ = {prime_1 + prime_2, prime_2, 0, 0 - prime_1};
  std::array<std::byte, block_size> block_ = {};  ///< The bytes that do not make a block yet.
  std::size_t filled_ = 0;                        ///< Their number.
  std::uint64_t total_ = 0;                       ///< The number of all bytes.
};

}  // namespace surehit::detail
