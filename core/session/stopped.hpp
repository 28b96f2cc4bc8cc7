#pragma once
#include "core/progress/stopped.hpp"
