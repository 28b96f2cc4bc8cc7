#include "core/map/bit_rows.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

std::uint64_t bit_of(const Eigen::Vector3i& cell) { return std::uint64_t{1} << (cell.x() % 64); }

/// Of each two bits next to each other, from the lowest on, whether any is set: in the lower half.
std::uint64_t any_of_pairs(std::uint64_t word) {
  word = (word | word >> 1) & 0x5555555555555555;
  word = (word | word >> 1) & 0x3333333333333333;
  word = (word | word >> 2) & 0x0f0f0f0f0f0f0f0f;
  word = (word | word >> 4) & 0x00ff00ff00ff00ff;
  word = (word | word >> 8) & 0x0000ffff0000ffff;
  return (word | word >> 16) & 0xffffffff;
}

/// Of each bit, the parity of those up to it.
std::uint64_t parities(std::uint64_t word) {
  for (int shift = 1; shift < 64; shift *= 2) word ^= word << shift;
  return word;
}

}  // namespace

BitRows::BitRows(const Eigen::Vector3i& size)
    : size_(size),
      row_words_((std::size_t(size.x()) + 63) / 64),
      last_word_(~std::uint64_t{0} >> (64 * row_words_ - std::size_t(size.x()))),
      words_(row_words_ * std::size_t(size.y()) * std::size_t(size.z())) {}

void BitRows::set(const Eigen::Vector3i& cell) {
  std::atomic_ref(word_of(cell)).fetch_or(bit_of(cell), std::memory_order_relaxed);
}

void BitRows::flip(const Eigen::Vector3i& cell) {
  std::atomic_ref(word_of(cell)).fetch_xor(bit_of(cell), std::memory_order_relaxed);
}

void BitRows::set_eight(const Eigen::Vector3i& first, std::uint8_t bits) {
  const std::size_t row = begin(first.y(), first.z());
  for (const int x : {first.x(), first.x() + 7}) {  // both may lie in the same word
    if (x < 0 || x >= static_cast<int>(64 * row_words_)) continue;
    const int shift = first.x() - x / 64 * 64;
    const std::uint64_t own = shift >= 0 ? std::uint64_t{bits} << shift : std::uint64_t{bits} >> -shift;
    words_[row + x / 64] |= std::size_t(x) / 64 + 1 == row_words_ ? own & last_word_ : own;
  }
}

/// Calls `visit(other, rows)` for the rows that lie one after the other along y or z, at the place `other` along the
/// third axis: `rows(k)` says where each begins. Several at once.
template <class Visit>
void BitRows::for_each_column_of_rows(int axis, const std::stop_token& stop, Visit visit) {
  tbb::parallel_for(0, axis == 1 ? size_.z() : size_.y(), [&](int other) {
    if (!stop.stop_requested())
      visit(other, [&, other](int k) { return axis == 1 ? begin(k, other) : begin(other, k); });
  });
  throw_if_stopped(stop);
}

void BitRows::accumulate(int axis, const BitRows& left_out, const std::stop_token& stop) {
  if (axis > 0)
    return for_each_column_of_rows(axis, stop, [&](int other, auto rows) {
      const std::uint64_t* const out = &left_out.words_[std::size_t(other) * row_words_];
      std::vector<std::uint64_t> parity(row_words_);
      for (int k = 0; k < size_[axis]; ++k)
        for (std::size_t w = 0; w < row_words_; ++w) {
          std::uint64_t& word = words_[rows(k) + w];
          word = (parity[w] ^= word) & ~out[w];
        }
    });
  for_each_column_of_rows(1, stop, [&](int, auto rows) {
    for (int y = 0; y < size_.y(); ++y) {
      std::uint64_t carried = 0;
      const std::uint64_t kept = left_out.words_[rows(y) / row_words_] & 1 ? 0 : ~std::uint64_t{0};
      for (std::size_t w = 0; w < row_words_; ++w) {
        const std::uint64_t parity = parities(words_[rows(y) + w]) ^ carried;
        carried = parity >> 63 ? ~std::uint64_t{0} : 0;
        words_[rows(y) + w] = parity & kept;
      }
    }
  });
}

void BitRows::grow(const std::stop_token& stop) {
  grow_along_rows();
  for (const int axis : {1, 2})
    for_each_column_of_rows(axis, stop, [&](int, auto rows) {
      std::vector<std::uint64_t> before(row_words_);
      for (int k = 0; k < size_[axis]; ++k)
        for (std::size_t w = 0; w < row_words_; ++w) {
          std::uint64_t& word = words_[rows(k) + w];
          const std::uint64_t own = word, after = k + 1 < size_[axis] ? words_[rows(k + 1) + w] : 0;
          word = before[w] | own | after;
          before[w] = own;
        }
    });
}

void BitRows::grow_along_rows() {
  std::uint64_t before = 0;
  for (std::size_t w = 0; w < words_.size(); ++w) {
    const bool is_first = w % row_words_ == 0, is_last = (w + 1) % row_words_ == 0;
    const std::uint64_t own = words_[w], from_left = is_first ? 0 : before >> 63,
                        from_right = is_last ? 0 : words_[w + 1] << 63;
    words_[w] = own | own << 1 | own >> 1 | from_left | from_right;
    if (is_last) words_[w] &= last_word_;
    before = own;
  }
}

BitRows BitRows::majority(const BitRows& a, const BitRows& b, const BitRows& c) {
  BitRows most = a;
  for (std::size_t w = 0; w < most.words_.size(); ++w)
    most.words_[w] = (a.words_[w] & b.words_[w]) | (c.words_[w] & (a.words_[w] | b.words_[w]));
  return most;
}

BitRows BitRows::either(const BitRows& a, const BitRows& b) {
  BitRows both = a;
  for (std::size_t w = 0; w < both.words_.size(); ++w) both.words_[w] |= b.words_[w];
  return both;
}

BitRows BitRows::complement() const {
  BitRows others = *this;
  for (std::size_t w = 0; w < words_.size(); ++w)
    others.words_[w] = ~words_[w] & ((w + 1) % row_words_ == 0 ? last_word_ : ~std::uint64_t{0});
  return others;
}

BitRows BitRows::halved() const {
  BitRows half((size_.array() + 1) / 2);
  tbb::parallel_for(0, half.size_.z(), [&](int z) {
    for (int y = 0; y < half.size_.y(); ++y)
      for (std::size_t w = 0; w < row_words_; ++w) {
        std::uint64_t any = 0;
        for (int fine_z = 2 * z; fine_z < std::min(2 * z + 2, size_.z()); ++fine_z)
          for (int fine_y = 2 * y; fine_y < std::min(2 * y + 2, size_.y()); ++fine_y)
            any |= words_[begin(fine_y, fine_z) + w];
        half.words_[half.begin(y, z) + w / 2] |= any_of_pairs(any) << (32 * (w % 2));
      }
  });
  return half;
}

std::uint32_t BitRows::around(const Eigen::Vector3i& cell) const {
  const std::size_t w = std::size_t(cell.x()) / 64;
  const int bit = cell.x() % 64;
  const auto is_inside = [&](int axis) { return cell[axis] > 0 && cell[axis] + 1 < size_[axis]; };
  std::uint32_t flags = 0;
  if (bit > 0 && bit < 63 && is_inside(1) && is_inside(2)) {  // nearly always
    const std::uint64_t* const first = &words_[begin(cell.y() - 1, cell.z() - 1) + w];
    const std::size_t layer = std::size_t(size_.y()) * row_words_;
    for (std::size_t n = 0; n < 9; ++n)
      flags |= static_cast<std::uint32_t>(first[n / 3 * layer + n % 3 * row_words_] >> (bit - 1) & 7) << (3 * n);
    return flags;
  }
  for (int n = 0; n < 9; ++n) {
    const int y = cell.y() + n % 3 - 1, z = cell.z() + n / 3 - 1;
    if (y < 0 || z < 0 || y >= size_.y() || z >= size_.z()) continue;
    const std::span<const std::uint64_t> words = row(y, z);
    std::uint64_t three = bit > 0 ? words[w] >> (bit - 1) : words[w] << 1 | (w > 0 ? words[w - 1] >> 63 : 0);
    if (bit == 63 && w + 1 < words.size()) three |= words[w + 1] << 2;
    flags |= static_cast<std::uint32_t>(three & 7) << (3 * n);
  }
  return flags;
}

namespace {

/// Of 3 x 3 flags in a layer: how many are set, and the sum of their ways from the middle.
struct Nine {
  std::int8_t count = 0, x = 0, y = 0;
};
constexpr auto nines = [] {  // not all processors have an instruction that counts
  std::array<Nine, 512> all;
  for (int flags = 0; flags < 512; ++flags)
    for (int n = 0; n < 9; ++n)
      if (flags >> n & 1) {
        Nine& nine = all[std::size_t(flags)];
        ++nine.count, nine.x += n % 3 - 1, nine.y += n / 3 - 1;
      }
  return all;
}();
/// Of BitRows::around, from the lowest layer on.
const Nine& layer_of(std::uint32_t around, int layer) { return nines[around >> (9 * layer) & 511]; }

}  // namespace

int BitRows::neighbours(const Eigen::Vector3i& cell) const {
  const std::uint32_t all = around(cell);
  return layer_of(all, 0).count + layer_of(all, 1).count + layer_of(all, 2).count -
         int(all >> 13 & 1);  // without itself
}

Eigen::Vector3i BitRows::ways_to_neighbours(const Eigen::Vector3i& cell) const {
  const std::uint32_t all = around(cell);
  const Nine &below = layer_of(all, 0), &beside = layer_of(all, 1), &above = layer_of(all, 2);
  return {below.x + beside.x + above.x, below.y + beside.y + above.y, above.count - below.count};
}

std::vector<std::uint32_t> BitRows::counts_before() const {
  std::vector<std::uint32_t> counts(words_.size() + 1);
  for (std::size_t w = 0; w < words_.size(); ++w)
    counts[w + 1] = counts[w] + static_cast<std::uint32_t>(std::popcount(words_[w]));
  return counts;
}

BitMask BitRows::mask() const {
  const std::size_t length = std::size_t(size_.x());
  BitMask mask(length * std::size_t(size_.y()) * std::size_t(size_.z()));
  for (std::size_t w = 0; w < words_.size(); ++w) {
    const std::size_t in_row = w % row_words_;
    mask.add_word(w / row_words_ * length + 64 * in_row, in_row + 1 == row_words_ ? words_[w] & last_word_ : words_[w]);
  }
  return mask;
}

}  // namespace nextview
