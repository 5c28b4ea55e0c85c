#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/measuring/batch_errors.hpp"
#include "harness/measuring/distance_errors.hpp"

namespace bqsa::harness::claims {
namespace {

Findings wrong_answers(const Arguments& arguments, Laboratory& laboratory) {
  constexpr int kDimension = 3;
  constexpr std::uint64_t kSeed = 9;
  const std::int64_t many = laboratory.samples(arguments.whole("pairs"));
  BatchErrors in_double, in_float;
  for (const PairFamily family : kPairFamilies) {
    const std::int64_t pairs = family == PairFamily::kRandom ? 3 * many : many;
    in_double += batch_errors_in_double(family, kDimension, pairs, kSeed);
    in_float += batch_errors_in_float(family, kDimension, pairs, kSeed);
  }
  const auto count = [](std::int64_t pairs) { return static_cast<double>(pairs); };
  return {.figures = {{"pairs", count(in_double.pairs)},
                      {"hits", count(in_double.hits)},
                      {"touching", count(in_double.in_band)},
                      {"wrong", count(in_double.missed + in_double.false_alarms)},
                      {"float_missed", count(in_float.missed)},
                      {"float_near", count(in_float.in_band)},
                      {"float_wrong_alarms", count(in_float.false_alarms)}},
          .remarks = {}};
}

Findings distance_errors(const Arguments& arguments, Laboratory& laboratory) {
  constexpr std::uint64_t kSeed = 1;
  const DistanceErrors errors =
      batched_distance_errors(laboratory.samples(arguments.whole("pairs")), kSeed);
  return {.figures = {{"pairs", static_cast<double>(errors.pairs)},
                      {"meeting", static_cast<double>(errors.meeting)},
                      {"disagreed", static_cast<double>(errors.disagreed)},
                      {"distance", errors.distance},
                      {"point", errors.point}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> answer_estimators() {
  return {
      {.name = "wrong_answers",
       .what = "The batched test in space, by all instruction sets of the processor, against "
               "113-bit arithmetic, on random pairs and on vertical, nearly vertical, zero-length, "
               "contained and tangent links and on some up to 1 km long",
       .arguments = {{"pairs", ArgumentKind::kWholeNumber, "50000",
                      "of each family in a quick evaluation, and three times as many random ones"}},
       .figures = {{"pairs", "-", "asked"},
                   {"hits", "-", "of them"},
                   {"touching", "-",
                    "of them: to within 1e-9 of the semi-axes, not judged in double"},
                   {"wrong", "-", "answers in double, of all others"},
                   {"float_missed", "-", "hits that single precision calls free, touching or not"},
                   {"float_near", "-", "free pairs within the derived margin, where it may err"},
                   {"float_wrong_alarms", "-", "free pairs beyond it that it calls hits"}},
       .estimate = wrong_answers},
      {.name = "distance_errors",
       .what = "The batched exact distance against bisection in extended precision, on random "
               "links and eggs",
       .arguments = {{"pairs", ArgumentKind::kWholeNumber, "5000", "in a quick evaluation"}},
       .figures = {{"pairs", "-", "asked"},
                   {"meeting", "-", "of them"},
                   {"disagreed", "-",
                    "on whether they meet, touching to within 1e-9 of the semi-axes left out"},
                   {"distance", "m", "largest error of a distance"},
                   {"point", "m", "largest error of the link's closest point, of pairs apart"}},
       .estimate = distance_errors}};
}

}  // namespace bqsa::harness::claims
