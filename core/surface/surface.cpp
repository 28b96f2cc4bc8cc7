#include "core/surface/surface.hpp"
