#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace nextview {

/// A flag for each of many things, in an eighth of a byte. All false at first.
class BitMask {
 public:
  BitMask() = default;
  explicit BitMask(std::size_t size) : size_(size), words_((size + 63) / 64) {}

  /// Of those that are not 0 in `bytes`, one each.
  explicit BitMask(std::span<const std::uint8_t> bytes) : BitMask(bytes.size()) { add(bytes); }

  std::size_t size() const { return size_; }
  std::size_t memory() const { return words_.size() * sizeof(std::uint64_t); }  ///< [bytes]
  bool operator[](std::size_t i) const { return words_[i / 64] >> (i % 64) & 1; }
  void set(std::size_t i, bool value = true) {
    const std::uint64_t bit = std::uint64_t{1} << (i % 64);
    words_[i / 64] = value ? words_[i / 64] | bit : words_[i / 64] & ~bit;
  }
  /// The 64 from `first` on, the first one's bit the lowest; beyond the end 0.
  std::uint64_t word(std::size_t first) const {
    const std::size_t at = first / 64, shift = first % 64;
    return words_[at] >> shift | (shift != 0 && at + 1 < words_.size() ? words_[at + 1] << (64 - shift) : 0);
  }
  /// Sets those of the next 64 from `first` on whose bit in `word` is 1, beginning with the lowest.
  /// @pre all that it sets are there
  void add_word(std::size_t first, std::uint64_t word);
  /// Sets those that are not 0 in `bytes`, one each. @pre bytes.size() == size()
  void add(std::span<const std::uint8_t> bytes);
  /// The same where the bytes lie in rows of so many, `row(number)` each. @pre size() is a multiple of it
  void add_rows(std::size_t length, const std::function<const std::uint8_t*(std::size_t number)>& row);
  /// Calls `visit(i)` for those that are set, in their order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t bits = words_[w]; bits != 0; bits &= bits - 1)
        visit(64 * w + std::size_t(std::countr_zero(bits)));
  }
  /// 0 or 1 each.
  std::vector<std::uint8_t> bytes() const;
  /// As they are kept, 64 each, to be written to a file and read again.
  const std::vector<std::uint64_t>& words() const { return words_; }
  /// @throws std::invalid_argument if they are not of as many
  void set_words(std::vector<std::uint64_t> words);
  bool operator==(const BitMask&) const = default;

 private:
  std::size_t size_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace nextview
