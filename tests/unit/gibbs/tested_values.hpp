#pragma once
#include <limits>

#include "core/gibbs/forward_sensor_model.hpp"

/// Values that several tests go through.
namespace nextview {

inline constexpr ForwardModel every_model[] = {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam,
                                               ForwardModel::attenuation};

/// What hardly any parameter may be.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace nextview
