#include "baselines/closest/least_squared_distances.hpp"

#include <limits>

// One version for each vector unit, chosen when the program starts. The sanitizers' runtime is not
// ready by then.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define BQSA_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BQSA_VECTOR_CLONES
#endif

namespace bqsa::baselines {

BQSA_VECTOR_CLONES
void least_squared_distances_2d(const PointArrays& from, const PointArrays& to, double* least) {
  const double* const x = to.x;
  const double* const y = to.y;
  const int count = to.count;
  for (int k = 0; k < from.count; ++k) {
    const double p_x = from.x[k], p_y = from.y[k];
    double smallest = std::numeric_limits<double>::max();
    for (int m = 0; m < count; ++m) {
      const double d_x = x[m] - p_x, d_y = y[m] - p_y;
      const double squared = d_x * d_x + d_y * d_y;
      smallest = squared < smallest ? squared : smallest;
    }
    least[k] = smallest;
  }
}

BQSA_VECTOR_CLONES
void least_squared_distances_3d(const PointArrays& from, const PointArrays& to, double* least) {
  const double* const x = to.x;
  const double* const y = to.y;
  const double* const z = to.z;
  const int count = to.count;
  for (int k = 0; k < from.count; ++k) {
    const double p_x = from.x[k], p_y = from.y[k], p_z = from.z[k];
    double smallest = std::numeric_limits<double>::max();
    for (int m = 0; m < count; ++m) {
      const double d_x = x[m] - p_x, d_y = y[m] - p_y, d_z = z[m] - p_z;
      const double squared = d_x * d_x + d_y * d_y + d_z * d_z;
      smallest = squared < smallest ? squared : smallest;
    }
    least[k] = smallest;
  }
}

}  // namespace bqsa::baselines
