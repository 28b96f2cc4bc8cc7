#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/memory/copy_on_write.hpp"

namespace nextview {

/// The voxels of a grid in bricks of 8 x 8 x 8. A copy costs a pointer: copies share their bricks, and a brick is
/// copied when one of them changes it. Of bricks that hold only unmeasured voxels there is one for all, and places
/// whose voxels are all the same may share one (UniformBricks). Copies may live in different threads. A voxel of an
/// occupancy map takes 5 bytes; what else a Voxel says follows from them.
class VoxelBricks {
 public:
  static constexpr int edge = 8;  ///< of a brick [voxels]
  static constexpr std::size_t brick_voxels = std::size_t{edge} * edge * edge;

  class Brick {
   public:
    Voxel operator[](std::size_t i) const {
      Voxel voxel{0.5f, 0.6931472f, voxel_class(i), measured(i), occlusion_distance(i), log_odds(i)};
      if (!told_.empty()) {
        voxel.probability = told_[i].probability, voxel.entropy = told_[i].entropy;
      } else if (voxel.measured) {
        const Belief& says = belief(voxel.log_odds);
        voxel.probability = static_cast<float>(says.probability), voxel.entropy = says.entropy;
      }
      return voxel;
    }
    bool measured(std::size_t i) const { return states_[i] & is_measured; }
    VoxelClass voxel_class(std::size_t i) const { return static_cast<VoxelClass>(states_[i] & class_bits); }
    float log_odds(std::size_t i) const { return measured(i) ? numbers_[i] : 0.0f; }
    std::uint16_t occlusion_distance(std::size_t i) const {
      return measured(i) ? std::uint16_t{0} : static_cast<std::uint16_t>(numbers_[i]);
    }
    float entropy(std::size_t i) const { return told_.empty() ? belief(log_odds(i)).entropy : told_[i].entropy; }
    /// Whether probability and entropy follow from the log-odds, as in an occupancy map.
    bool follows_from_log_odds() const { return told_.empty(); }
    std::size_t measured_count() const;
    /// Whether all its voxels are kept as the first one is.
    bool is_uniform() const;

    void set_measured(std::size_t i, float log_odds, VoxelClass voxel_class) {
      numbers_[i] = log_odds;
      states_[i] = is_measured | static_cast<std::uint8_t>(voxel_class);
    }
    /// Of an unmeasured voxel, how far it lies behind a surface [voxels].
    void set_occlusion_distance(std::size_t i, std::uint16_t distance) { numbers_[i] = distance; }
    /// Whether none of its voxels is measured or marked.
    bool holds_nothing() const;
    /// What the voxels are kept as, to be written to a file and read again. The map's own: what is told is not in it.
    const std::array<float, brick_voxels>& numbers() const { return numbers_; }
    const std::array<std::uint8_t, brick_voxels>& states() const { return states_; }
    /// @throws std::invalid_argument: no voxels are kept as these
    void set(const std::array<float, brick_voxels>& numbers, const std::array<std::uint8_t, brick_voxels>& states);
    /// As it is told, whatever the log-odds.
    void set(std::size_t i, const Voxel& voxel);

    std::size_t bytes() const { return sizeof *this + told_.size() * sizeof(Told); }

   private:
    static constexpr std::uint8_t class_bits = 3, is_measured = 4;
    struct Told {
      float probability = 0.5f, entropy = 0.6931472f;
    };
    std::array<float, brick_voxels> numbers_{};        ///< log-odds if measured, else the occlusion distance
    std::array<std::uint8_t, brick_voxels> states_{};  ///< class and whether it is measured
    std::vector<Told> told_;                           ///< of maps whose voxels do not follow from log-odds
  };

  /// Unmeasured voxels, `size` of them along each axis.
  explicit VoxelBricks(const Eigen::Vector3i& size = Eigen::Vector3i::Zero());
  /// Of voxels in the grid's order, x fastest, as they are; 13 bytes each. @throws std::invalid_argument if there are
  /// not as many.
  VoxelBricks(const Eigen::Vector3i& size, std::span<const Voxel> voxels);
  /// The same of voxels that are nowhere yet: `voxel_of` is asked for each by its number in the grid, from any thread.
  static VoxelBricks made_of(const Eigen::Vector3i& size, const std::function<Voxel(std::size_t)>& voxel_of);

  std::size_t size() const { return std::size_t(size_.x()) * size_.y() * size_.z(); }  ///< voxels
  const Eigen::Vector3i& edges() const { return size_; }                               ///< voxels along each axis
  const Eigen::Vector3i& brick_edges() const { return bricks_; }                       ///< bricks along each axis
  std::size_t brick_count() const { return table_->size(); }

  /// Where a voxel stands when voxels are counted brick by brick, x fastest in both.
  std::size_t place(int x, int y, int z) const {
    const std::size_t brick = (std::size_t(z >> 3) * bricks_.y() + (y >> 3)) * bricks_.x() + (x >> 3);
    return brick * brick_voxels + ((z & 7) << 6 | (y & 7) << 3 | (x & 7));
  }
  /// The position of the voxel in the grid. Places beyond the grid's edges, of bricks that stick out, have one too;
  /// their voxels are never measured.
  Eigen::Vector3i cell(std::size_t place) const;

  Voxel at(int x, int y, int z) const {
    const std::size_t p = place(x, y, z);
    return (*(*table_)[p / brick_voxels])[p % brick_voxels];
  }
  /// Calls `visit(first, cell, count)` for each row of voxels along x that a brick has in the grid: the number of its
  /// first one in the brick, its position in the grid, and how many there are.
  template <class Visit>
  void for_each_row(std::size_t brick, Visit visit) const {
    const Eigen::Vector3i lowest = cell(brick * brick_voxels), size = (size_ - lowest).cwiseMin(edge);
    for (int z = 0; z < size.z(); ++z)
      for (int y = 0; y < size.y(); ++y)
        visit(std::size_t(z * edge + y) * edge, lowest + Eigen::Vector3i(0, y, z), std::size_t(size.x()));
  }
  /// By the grid's number. Slower than walking.
  Voxel operator[](std::size_t voxel) const;

  /// The brick of a place, to be changed; there the voxel is the `place % brick_voxels`-th.
  Brick& change_brick_of(std::size_t place) { return table_.change()[place / brick_voxels].change(); }
  /// The bricks, to be changed: different ones from different threads.
  std::span<CopyOnWrite<Brick>> change_bricks() { return table_.change(); }
  std::span<const CopyOnWrite<Brick>> bricks() const { return *table_; }

  /// Walks the voxels in the grid's order.
  class Iterator {
   public:
    using value_type = Voxel;
    using difference_type = std::ptrdiff_t;
    using reference = Voxel;
    using iterator_concept = std::forward_iterator_tag;
    using iterator_category = std::input_iterator_tag;  // it has no Voxel to refer to
    Iterator() = default;
    Iterator(const VoxelBricks& bricks, std::size_t voxel);
    Voxel operator*() const { return (*brick_)[in_brick_]; }
    Iterator& operator++() {
      ++number_, ++in_brick_;
      if ((++x_ & (edge - 1)) == 0 || x_ == bricks_->size_.x()) jump();
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return number_ == other.number_; }

   private:
    void jump();
    void find();
    const VoxelBricks* bricks_ = nullptr;
    const Brick* brick_ = nullptr;
    std::size_t number_ = 0, in_brick_ = 0;
    int x_ = 0, y_ = 0, z_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }
  /// From a voxel on, by the grid's number.
  Iterator from(std::size_t voxel) const { return {*this, voxel}; }
  /// All of them, in the grid's order.
  std::vector<Voxel> dense() const;

  /// Whether nothing was ever said of a brick's voxels.
  bool is_untouched(std::size_t brick) const { return bricks()[brick].shares_with(empty_); }
  /// What the bricks take that hold anything [bytes]; one that several places share counts once.
  std::size_t bytes() const;
  /// Whether they are copies, and neither was changed since.
  bool shares_all_with(const VoxelBricks& other) const { return table_.shares_with(other.table_); }
  /// What of it `other`, of the same size, does not share [bytes].
  std::size_t bytes_beside(const VoxelBricks& other) const;

 private:
  void set_each(const std::function<Voxel(std::size_t)>& voxel_of);

  Eigen::Vector3i size_, bricks_;
  CopyOnWrite<Brick> empty_;
  CopyOnWrite<std::vector<CopyOnWrite<Brick>>> table_;
};

/// In the grid's order.
std::vector<float> probabilities(const VoxelBricks& voxels);

}  // namespace nextview
