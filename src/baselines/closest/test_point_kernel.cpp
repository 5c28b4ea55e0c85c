// A file that is compiled for several instruction sets includes nothing whose inline functions others
// use too.
#include "baselines/closest/test_point_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "baselines/closest/test_point_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa::baselines::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kPointBlock>;
using Vec = hn::Vec<Tag>;
constexpr double kFarthest = 1e300;  // [m²]
constexpr auto kLanes = static_cast<std::ptrdiff_t>(hn::MaxLanes(Tag()));

template <bool Fused>
HWY_INLINE Vec plus_square(Vec sum, Vec x) {
  return Fused ? hn::MulAdd(x, x, sum) : hn::Add(sum, hn::Mul(x, x));
}

template <int Dim, bool Fused>
HWY_INLINE Vec squared_distance(Vec x, Vec y, Vec z, Vec p_x, Vec p_y, Vec p_z) {
  const Vec d_x = hn::Sub(x, p_x);
  const Vec d_y = hn::Sub(y, p_y);
  Vec squared = plus_square<Fused>(hn::Mul(d_x, d_x), d_y);
  if constexpr (Dim == 3) {
    const Vec d_z = hn::Sub(z, p_z);
    squared = plus_square<Fused>(squared, d_z);
  }
  return squared;
}

/// For each of `Together` points from number k on, the least of its squared distances to the points in
/// every lane of a block: what is loaded serves all of them.
template <int Dim, bool Fused, int Together>
HWY_INLINE void least_of_block(const TestPointPass& pass, const double* block, int k, Vec* least) {
  const Tag tag;
  Vec p_x[Together], p_y[Together], p_z[Together], smallest[Together];
  for (int i = 0; i < Together; ++i) {
    p_x[i] = hn::Set(tag, pass.points.x[k + i]);
    p_y[i] = hn::Set(tag, pass.points.y[k + i]);
    p_z[i] = Dim == 3 ? hn::Set(tag, pass.points.z[k + i]) : hn::Zero(tag);
    smallest[i] = hn::Set(tag, kFarthest);
  }
  const double* row = block;
  for (int r = 0; r < pass.rows; ++r, row += Dim * kPointBlock) {
    const Vec x = hn::LoadU(tag, row);
    const Vec y = hn::LoadU(tag, row + kPointBlock);
    const Vec z = Dim == 3 ? hn::LoadU(tag, row + 2 * kPointBlock) : hn::Zero(tag);
    for (int i = 0; i < Together; ++i) {
      smallest[i] =
          hn::Min(smallest[i], squared_distance<Dim, Fused>(x, y, z, p_x[i], p_y[i], p_z[i]));
    }
  }
  for (int i = 0; i < Together; ++i) least[i] = smallest[i];
}

/// Points that are next to each other are looked at together, whatever group they belong to.
template <int Dim, bool Fused>
class Groups {
 public:
  /// Those of a block's lanes from `lane` on.
  HWY_INLINE Groups(const TestPointPass& pass, std::ptrdiff_t block, std::ptrdiff_t lane)
      : pass_(pass),
        block_(pass.blocks + block * pass.rows * Dim * kPointBlock + lane),
        first_lanes_(lane == 0),
        smallest_(hn::Set(Tag(), kFarthest)) {
    const std::ptrdiff_t groups = pass.points.count / pass.count;
    out_ = pass.least + block * groups * (pass.across ? 1 : kPointBlock) + (pass.across ? 0 : lane);
  }

  HWY_INLINE void write_all() {
    constexpr int kTogether = 4;
    int k = 0;
    for (; k + kTogether <= pass_.points.count; k += kTogether) look<kTogether>(k);
    for (; k < pass_.points.count; ++k) look<1>(k);
  }

 private:
  template <int Together>
  HWY_INLINE void look(int k) {
    Vec least[Together];
    least_of_block<Dim, Fused, Together>(pass_, block_, k, least);
    for (const Vec each : least) {
      smallest_ = hn::Min(smallest_, each);
      if (++looked_at_ == pass_.count) write();
    }
  }

  HWY_INLINE void write() {
    const Tag tag;
    if (pass_.across) {
      const double least = hn::GetLane(hn::MinOfLanes(tag, smallest_));
      if (first_lanes_ || least < *out_) *out_ = least;
      ++out_;
    } else {
      hn::StoreU(smallest_, tag, out_);
      out_ += kPointBlock;
    }
    smallest_ = hn::Set(tag, kFarthest);
    looked_at_ = 0;
  }

  const TestPointPass& pass_;
  const double* block_;
  bool first_lanes_;
  double* out_;  // of the group at hand
  Vec smallest_;
  int looked_at_ = 0;  // points of the group at hand
};

template <int Dim, bool Fused>
HWY_INLINE void all_blocks(const TestPointPass& pass) {
  for (std::ptrdiff_t block = 0; block < pass.block_count; ++block) {
    for (std::ptrdiff_t lane = 0; lane < kPointBlock; lane += kLanes)
      Groups<Dim, Fused>(pass, block, lane).write_all();
  }
}

void test_point_pass(const TestPointPass& pass) {
  if (pass.dimension == 2) {
    pass.fused ? all_blocks<2, true>(pass) : all_blocks<2, false>(pass);
  } else {
    pass.fused ? all_blocks<3, true>(pass) : all_blocks<3, false>(pass);
  }
}

}  // namespace bqsa::baselines::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::baselines {

HWY_EXPORT(test_point_pass);

void run_test_point_pass(const TestPointPass& pass) { HWY_DYNAMIC_DISPATCH(test_point_pass)(pass); }

}  // namespace bqsa::baselines
#endif
