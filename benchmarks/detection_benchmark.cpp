// Time of one link-obstacle test, form by form, and of the fields that BQSA asks, in space and by
// projections. Inputs are made, and the forms' answers compared with each other, before anything is
// timed.

#include <benchmark/benchmark.h>

#include <Eigen/QR>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "bqsa/geometry/paper_form.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/shadow_field.hpp"

namespace bqsa {
namespace {

constexpr int kPairs = 1000;
constexpr int kLinksPerChain = 10;  // for the forms that share end-points: 100 chains

/// A thousand pairs, laid out as chains: link k of a chain joins its points k and k + 1.
template <int Dim>
struct Inputs {
  using Vector = Eigen::Matrix<double, Dim, 1>;

  struct Chain {
    EllipsoidN<Dim> obstacle;
    std::vector<Vector> points;
  };

  Inputs() {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> axis(0.05, 0.5), place(-1, 1);
    std::normal_distribution<double> normal;
    const auto vector = [&] {
      return Vector(Vector::NullaryExpr([&] { return place(generator); }));
    };
    for (int i = 0; i < kPairs / kLinksPerChain; ++i) {
      using Matrix = Eigen::Matrix<double, Dim, Dim>;
      const Matrix random = Matrix::NullaryExpr([&] { return normal(generator); });
      Matrix rotation = Eigen::HouseholderQR<Matrix>(random).householderQ();
      if (rotation.determinant() < 0) rotation.col(0) = -rotation.col(0);
      const Vector axes = Vector::NullaryExpr([&] { return axis(generator); });
      chains.push_back({{vector(), axes, rotation}, {vector()}});
      for (int k = 0; k < kLinksPerChain; ++k) chains.back().points.push_back(vector());
    }
  }

  std::vector<Chain> chains;
};

/// Calls `test(obstacle, p1, p2)` for all pairs; the number of hits.
template <int Dim, typename Test>
int count_hits(const Inputs<Dim>& inputs, const Test& test) {
  int hit_count = 0;
  for (const auto& [obstacle, points] : inputs.chains) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      hit_count += test(obstacle, points[k], points[k + 1]);
    }
  }
  return hit_count;
}

template <int Dim>
int polar_hits(const Inputs<Dim>& inputs) {
  return count_hits<Dim>(inputs, [](const auto& obstacle, const auto& p1, const auto& p2) {
    return is_hit(category(polar_form<Dim>(obstacle, p1, p2)));
  });
}

template <int Dim>
int parameter_hits(const Inputs<Dim>& inputs) {
  return count_hits<Dim>(inputs, [](const auto& obstacle, const auto& p1, const auto& p2) {
    return is_hit(category(
        parameter_form<double, Dim>(unit_point<Dim>(obstacle, p1), unit_point<Dim>(obstacle, p2))));
  });
}

/// The polar form with each end-point mapped once for the two links that share it.
template <int Dim>
int shared_polar_hits(const Inputs<Dim>& inputs) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  int hit_count = 0;
  for (const auto& [obstacle, points] : inputs.chains) {
    Vector u = unit_point<Dim>(obstacle, points[0]);
    double level = inner(u, u) - 1;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector next = unit_point<Dim>(obstacle, points[k]);
      const double next_level = inner(next, next) - 1;
      hit_count += is_hit(category(PolarForm<double>{level, inner(u, next) - 1, next_level}));
      for (int i = 0; i < Dim; ++i) u(i) = next(i);  // one by one, as they were stored
      level = next_level;
    }
  }
  return hit_count;
}

/// The paper's form. Its conic coefficients are given, as the paper assumes; one conic a chain.
template <typename Form>
int paper_hits(const Inputs<2>& inputs, const std::vector<Conic<double>>& conics,
               const Form& form) {
  int hit_count = 0;
  for (std::size_t i = 0; i < conics.size(); ++i) {
    const auto& points = inputs.chains[i].points;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const PaperForm<double> f = form(conics[i], points[k], points[k + 1]);
      hit_count += is_hit(paper_category(f, points[k].x(), points[k + 1].x()));
    }
  }
  return hit_count;
}

const Inputs<2> kPlane;
const Inputs<3> kSpace;

std::vector<Conic<double>> conics_of(const Inputs<2>& inputs) {
  std::vector<Conic<double>> conics;
  for (const auto& chain : inputs.chains) conics.push_back(conic_from_ellipse(chain.obstacle));
  return conics;
}

const std::vector<Conic<double>> kConics = conics_of(kPlane);

int paper_as_printed() { return paper_hits(kPlane, kConics, paper_form<double>); }
int paper_shared() { return paper_hits(kPlane, kConics, paper_form_shared<double>); }

/// A chain's obstacle as Field sees it, and the chain as a pose.
template <typename Field>
struct Asked {
  Field field;
  ChainPose pose;
};

template <typename Field>
std::vector<Asked<Field>> asked(const Inputs<3>& inputs, WorkCounters& counters) {
  std::vector<Asked<Field>> all;
  for (const auto& [obstacle, points] : inputs.chains) {
    Asked<Field>& chain = all.emplace_back();
    chain.field.assign({{"obstacle", obstacle}}, counters);
    chain.pose.p_WO.resize(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
      chain.pose.p_WO.col(static_cast<Eigen::Index>(k)) = points[k];
    }
  }
  return all;
}

WorkCounters space_work, shadow_work;
const std::vector<Asked<ObstacleField<3>>> kSpaceFields =
    asked<ObstacleField<3>>(kSpace, space_work);
const std::vector<Asked<ShadowField>> kShadowFields = asked<ShadowField>(kSpace, shadow_work);

template <typename Field>
int field_hits(const std::vector<Asked<Field>>& chains) {
  int hit_count = 0;
  for (const Asked<Field>& chain : chains) {
    for (int k = 0; k < kLinksPerChain; ++k) {
      hit_count += chain.field.first_hit(chain.pose, {k + 1, k, k + 1}) >= 0;
    }
  }
  return hit_count;
}

int space_field_hits() { return field_hits(kSpaceFields); }
int shadow_field_hits() { return field_hits(kShadowFields); }

/// Quadratics that a field evaluates in one pass, a pair.
double quadratics_per_pair(int (*hits)(), const WorkCounters& work) {
  const std::uint64_t before = work.quadratics;
  hits();
  return static_cast<double>(work.quadratics - before) / kPairs;
}

/// Times `hits()`, a pass over all pairs; "per_pair" is seconds a pair.
template <typename Hits>
void time_pairs(benchmark::State& state, const Hits& hits) {
  for (auto _ : state) {
    int hit_count = hits();
    benchmark::DoNotOptimize(hit_count);
  }
  using benchmark::Counter;
  state.counters["per_pair"] =
      Counter(kPairs, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void register_all() {
  const auto add = [](const char* name, int (*hits)()) {
    benchmark::RegisterBenchmark(name, [hits](benchmark::State& s) { time_pairs(s, hits); });
  };
  add("plane/paper_form", paper_as_printed);
  add("plane/paper_form_shared", paper_shared);
  add("plane/parameter_form", [] { return parameter_hits(kPlane); });
  add("plane/polar_form", [] { return polar_hits(kPlane); });
  add("plane/polar_form_shared_ends", [] { return shared_polar_hits(kPlane); });
  add("space/parameter_form", [] { return parameter_hits(kSpace); });
  add("space/polar_form", [] { return polar_hits(kSpace); });
  add("space/polar_form_shared_ends", [] { return shared_polar_hits(kSpace); });
  const auto add_field = [](const char* name, int (*hits)(), const WorkCounters& work) {
    benchmark::RegisterBenchmark(name, [hits, &work](benchmark::State& s) {
      time_pairs(s, hits);
      s.counters["quadratics"] = quadratics_per_pair(hits, work);
      s.counters["hits"] = static_cast<double>(hits()) / kPairs;
    });
  };
  add_field("field/space", space_field_hits, space_work);
  add_field("field/projections", shadow_field_hits, shadow_work);
}

/// Whether all forms find the same hits, and neither none nor only hits.
bool forms_agree() {
  const int plane = polar_hits(kPlane), space = polar_hits(kSpace);
  return plane > 0 && plane < kPairs && space > 0 && space < kPairs &&
         plane == paper_as_printed() && plane == paper_shared() &&
         plane == parameter_hits(kPlane) && plane == shared_polar_hits(kPlane) &&
         space == parameter_hits(kSpace) && space == shared_polar_hits(kSpace) &&
         space == space_field_hits() && space < shadow_field_hits();
}

}  // namespace
}  // namespace bqsa

int main(int argc, char** argv) {
  if (!bqsa::forms_agree()) {
    std::fputs("detection_benchmark: the forms disagree on a hit; nothing timed\n", stderr);
    return EXIT_FAILURE;
  }
  bqsa::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
}
