#include "core/map/bit_mask.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace nextview {
namespace {

/// Calls `visit(word, first, count)` for each word of `size` flags, with its first flag and how many it holds.
template <class Visit>
void for_each_word(std::size_t size, Visit visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (size + 63) / 64, 1024), [&](const auto& range) {
    for (std::size_t w = range.begin(); w != range.end(); ++w)
      visit(w, 64 * w, std::min<std::size_t>(64, size - 64 * w));
  });
}

/// A bit for each of `count` bytes, at most 64, the first one's the lowest: whether it is not 0.
std::uint64_t packed(const std::uint8_t* bytes, std::size_t count) {
  constexpr std::uint64_t lowest_bits = 0x0101010101010101, gather = 0x0102040810204080;
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes + i, std::min<std::size_t>(8, count - i));
    if (eight == 0) continue;
    for (const int shift : {4, 2, 1})
      eight |= eight >> shift;                            // into each byte's lowest bit, if any of its bits is set
    word |= ((eight & lowest_bits) * gather >> 56) << i;  // the product has them side by side at its top
  }
  return word;
}

}  // namespace

void BitMask::add_word(std::size_t first, std::uint64_t word) {
  if (word == 0) return;
  words_[first / 64] |= word << (first % 64);
  const std::uint64_t rest = first % 64 == 0 ? 0 : word >> (64 - first % 64);
  if (rest != 0) words_[first / 64 + 1] |= rest;
}

void BitMask::add(std::span<const std::uint8_t> bytes) {
  for_each_word(
      size_, [&](std::size_t w, std::size_t first, std::size_t count) { words_[w] |= packed(&bytes[first], count); });
}

void BitMask::add_rows(std::size_t length, const std::function<const std::uint8_t*(std::size_t number)>& row) {
  for_each_word(size_, [&](std::size_t w, std::size_t first, std::size_t count) {
    for (std::size_t done = 0; done < count;) {  // a word may reach over several rows
      const std::size_t in_row = (first + done) % length, part = std::min(count - done, length - in_row);
      words_[w] |= packed(row((first + done) / length) + in_row, part) << done;
      done += part;
    }
  });
}

void BitMask::set_words(std::vector<std::uint64_t> words) {
  const std::uint64_t beyond = size_ % 64 == 0 ? 0 : ~std::uint64_t{0} << (size_ % 64);
  if (words.size() != words_.size() || (!words.empty() && (words.back() & beyond) != 0))
    throw std::invalid_argument("bit mask: the words are of another number of flags");
  words_ = std::move(words);
}

std::vector<std::uint8_t> BitMask::bytes() const {
  std::vector<std::uint8_t> bytes(size_);
  for_each_word(size_, [&](std::size_t w, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) bytes[first + i] = words_[w] >> i & 1;
  });
  return bytes;
}

}  // namespace nextview
