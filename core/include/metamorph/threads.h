#pragma once

namespace metamorph::core {

/// The number of threads that is meant by an option of that value: itself if above 0, all that
/// OpenMP offers if 0 (OMP_NUM_THREADS, or the cores there are).
int thread_count(int asked);

}  // namespace metamorph::core
