#pragma once

namespace nextview {

/// How many threads of `wanted` can run beside those that run now: limits (`ulimit -u`, `ulimit -v`) may allow fewer.
/// They are started and ended.
int startable_threads(int wanted);

}  // namespace nextview
