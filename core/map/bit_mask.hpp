#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace nextview {

/// A flag for each of many things, in an eighth of a byte. All false at first.
class BitMask {
 public:
  explicit BitMask(std::size_t size = 0) : size_(size), words_((size + 63) / 64) {}

  std::size_t size() const { return size_; }
  std::size_t memory() const { return words_.size() * sizeof(std::uint64_t); }  ///< [bytes]
  bool operator[](std::size_t i) const { return words_[i / 64] >> (i % 64) & 1; }
  /// Sets those that are not 0 in `bytes`, one each. @pre bytes.size() == size()
  void add(std::span<const std::uint8_t> bytes);
  /// The same where the bytes lie in rows of so many, `row(number)` each. @pre size() is a multiple of it
  void add_rows(std::size_t length, const std::function<const std::uint8_t*(std::size_t number)>& row);
  /// 0 or 1 each.
  std::vector<std::uint8_t> bytes() const;
  bool operator==(const BitMask&) const = default;

 private:
  std::size_t size_;
  std::vector<std::uint64_t> words_;
};

}  // namespace nextview
