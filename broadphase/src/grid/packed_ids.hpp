#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <type_traits>

#include "support/default_init_allocator.hpp"

namespace surehit::detail {

class PackedIds;

/// Reads packed ids one by one.
class PackedIdIterator {
 public:
  // NOLINTBEGIN(readability-identifier-naming): what iterators are asked for
  using iterator_concept = std::random_access_iterator_tag;
  using iterator_category = std::input_iterator_tag;
  using value_type = std::uint32_t;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = std::uint32_t;
  // NOLINTEND(readability-identifier-naming)

  PackedIdIterator() = default;
  PackedIdIterator(const PackedIds* ids, std::size_t index) : ids_(ids), index_(static_cast<std::ptrdiff_t>(index)) {}

  std::uint32_t operator*() const;
  std::uint32_t operator[](std::ptrdiff_t n) const { return *(*this + n); }
  PackedIdIterator& operator+=(std::ptrdiff_t n) {
    index_ += n;
    return *this;
  }
  PackedIdIterator& operator-=(std::ptrdiff_t n) { return *this += -n; }
  PackedIdIterator& operator++() { return *this += 1; }
  PackedIdIterator& operator--() { return *this -= 1; }
  PackedIdIterator operator++(int) {
    const PackedIdIterator old = *this;
    ++*this;
    return old;
  }
  PackedIdIterator operator--(int) {
    const PackedIdIterator old = *this;
    --*this;
    return old;
  }
  friend PackedIdIterator operator+(PackedIdIterator at, std::ptrdiff_t n) { return at += n; }
  friend PackedIdIterator operator+(std::ptrdiff_t n, PackedIdIterator at) { return at += n; }
  friend PackedIdIterator operator-(PackedIdIterator at, std::ptrdiff_t n) { return at -= n; }
  friend std::ptrdiff_t operator-(const PackedIdIterator& a, const PackedIdIterator& b) { return a.index_ - b.index_; }
  friend bool operator==(const PackedIdIterator& a, const PackedIdIterator& b) { return a.index_ == b.index_; }
  friend auto operator<=>(const PackedIdIterator& a, const PackedIdIterator& b) { return a.index_ <=> b.index_; }

 private:
  const PackedIds* ids_ = nullptr;
  std::ptrdiff_t index_ = 0;
};

/// A sequence of ids below some end. Each id takes two, three or four bytes: as few as the largest one needs.
class PackedIds {
 public:
  /// Some ids in a row. They must outlive this.
  class Range {
   public:
    Range(PackedIdIterator begin, PackedIdIterator end) : begin_(begin), end_(end) {}

    [[nodiscard]] PackedIdIterator begin() const { return begin_; }
    [[nodiscard]] PackedIdIterator end() const { return end_; }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
    [[nodiscard]] bool empty() const { return begin_ == end_; }
    [[nodiscard]] std::uint32_t front() const { return *begin_; }
    std::uint32_t operator[](std::size_t index) const { return begin_[static_cast<std::ptrdiff_t>(index)]; }

   private:
    PackedIdIterator begin_;
    PackedIdIterator end_;
  };

  /// Removes all ids. Those that are appended from now on must be below `end`.
  void clear(std::size_t end) {
    bytes_.clear();
    size_ = 0;
    width_ = end <= std::size_t{1} << 16 ? 2 : end <= std::size_t{1} << 24 ? 3 : 4;
    mask_ = ~std::uint32_t{0} >> (32 - 8 * width_);
  }
  /// Makes room for this many ids.
  void reserve(std::size_t ids) { bytes_.reserve(ids * width_ + slack); }
  /// Gives back unused room.
  void shrink_to_fit() { bytes_.shrink_to_fit(); }
  /// Appends `id(number)` for each of the numbers.
  template <typename Id>
  void append(std::span<const std::uint32_t> numbers, const Id& id) {
    const std::size_t first = size_ * width_;
    bytes_.resize(first + numbers.size() * width_ + slack);
    size_ += numbers.size();
    std::uint8_t* to = bytes_.data() + first;
    const auto append_in = [&](auto width) {
      for (const std::uint32_t number : numbers) {
        const std::uint32_t value = id(number);
        std::memcpy(to, &value, width);  // The low bytes come first.
        to += width;
      }
    };
    if (width_ == 2) {
      append_in(std::integral_constant<std::size_t, 2>());
    } else if (width_ == 3) {
      append_in(std::integral_constant<std::size_t, 3>());
    } else {
      append_in(std::integral_constant<std::size_t, 4>());
    }
  }

  /// Becomes the ids that lie in these bytes, each in `width` bytes. `clear` must come first.
  void assign(std::span<const std::byte> bytes) {
    bytes_.resize(bytes.size() + slack);
    std::memcpy(bytes_.data(), bytes.data(), bytes.size());
    size_ = bytes.size() / width_;
  }

  [[nodiscard]] std::uint32_t operator[](std::size_t index) const {
    std::uint32_t value;
    std::memcpy(&value, address(index), sizeof(value));
    return value & mask_;
  }
  /// Returns where an id lies in memory.
  [[nodiscard]] const std::uint8_t* address(std::size_t index) const { return bytes_.data() + index * width_; }
  /// Returns all ids, one after the other.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_ * width_}; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] PackedIdIterator begin() const { return {this, 0}; }
  [[nodiscard]] PackedIdIterator end() const { return {this, size_}; }
  /// Returns the ids from index `first` to below `last`. The range refers to this.
  [[nodiscard]] Range between(std::size_t first, std::size_t last) const { return {{this, first}, {this, last}}; }
  /// Returns the number of bytes that an id takes.
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Returns the number of ids that there is room for.
  [[nodiscard]] std::size_t capacity() const { return bytes_.capacity() / width_; }
  [[nodiscard]] std::size_t memory_bytes() const { return bytes_.capacity(); }

 private:
  static_assert(std::endian::native == std::endian::little);
  /// Reading the last id may load so many bytes behind it.
  static constexpr std::size_t slack = 2;

  UnsetVector<std::uint8_t> bytes_;  ///< Longer by `slack` than all ids, or empty.
  std::size_t size_ = 0;
  std::size_t width_ = 4;
  std::uint32_t mask_ = ~std::uint32_t{0};  ///< The bits of an id.
};

inline std::uint32_t PackedIdIterator::operator*() const { return (*ids_)[static_cast<std::size_t>(index_)]; }

}  // namespace surehit::detail
