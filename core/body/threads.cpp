#include "metamorph/threads.h"

#include <omp.h>

namespace metamorph::core {

int thread_count(int asked) { return asked > 0 ? asked : omp_get_max_threads(); }

}  // namespace metamorph::core
