#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/robot.hpp"

namespace nextview {

/// A line that a driver answered with. Whoever asks for a value says what it has to be.
class DriverAnswer {
 public:
  /// @throws std::invalid_argument with what is wrong, as all that follow: it is no JSON object, it has no `id`
  explicit DriverAnswer(const std::string& line);
  ~DriverAnswer();
  DriverAnswer(DriverAnswer&&) noexcept;
  DriverAnswer& operator=(DriverAnswer&&) noexcept;

  std::uint64_t id() const { return id_; }
  /// Why it did not do what it was asked; none if it says `ok: true`.
  std::optional<std::string> error() const;

  static constexpr double over_zero = std::numeric_limits<double>::min();  ///< as the least that a number may be
  static constexpr double unlimited = std::numeric_limits<double>::max();  ///< as the most that a number may be
  bool has(const char* key) const;                                         ///< null counts as nothing
  double number(const char* key, double least, double most) const;
  int whole_number(const char* key, int least, int most) const;
  std::vector<double> numbers(const char* key, std::size_t count) const;
  std::string text(const char* key) const;
  std::vector<std::string> texts(const char* key) const;
  std::map<std::string, std::string> texts_by_key(const char* key) const;
  /// 16 numbers by rows. What is a rotation but for the digits it was printed with is made one; what is one stays as it
  /// is to the bit.
  Pose pose(const char* key) const;
  /// A list of poses, each of 16 numbers by rows; at most 100,000.
  std::vector<Pose> poses(const char* key) const;
  /// A list with so many entries, each with `unreachable` or what the move costs.
  std::vector<Reach> reaches(const char* key, std::size_t count) const;

 private:
  struct Object;
  std::unique_ptr<Object> object_;
  std::uint64_t id_ = 0;
};

/// A pose of 16 numbers by rows. @throws std::invalid_argument as DriverAnswer::pose
Pose pose_of(const std::vector<double>& by_rows);
std::vector<double> by_rows(const Pose& pose);

/// What others have written, as a part of one line for people.
std::string excerpt(const std::string& text);

}  // namespace nextview
