#include "harness/statistics/comparison.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>
#include <vector>

namespace bqsa::harness {
namespace {

double two_sided_sign_test(int less, int more) {
  const int n = less + more;
  if (n == 0) return 1;
  const boost::math::binomial_distribution<> fair(n, 0.5);
  return std::min(1.0, 2 * cdf(fair, std::min(less, more)));
}

/// P(U <= u) if both samples are draws of one continuous distribution: the share of the orders of
/// n + m values in which U is so small. Counts of orders by the recursion of Mann and Whitney.
double exact_lower_tail(int u, std::size_t n, std::size_t m) {
  const std::size_t most = n * m;
  // ways[j][w]: orders of i values of a and j of b with U = w, as i grows from 0 to n.
  std::vector<std::vector<double>> ways(m + 1, std::vector<double>(most + 1, 0));
  for (std::vector<double>& of_none : ways) of_none[0] = 1;
  for (std::size_t i = 1; i <= n; ++i) {
    // The largest value is one of a, which exceeds all j of b, or one of b.
    for (std::size_t j = 1; j <= m; ++j) {
      std::vector<double>& here = ways[j];
      for (std::size_t w = most + 1; w-- > 0;) here[w] = w >= j ? here[w - j] : 0;
      for (std::size_t w = 0; w <= most; ++w) here[w] += ways[j - 1][w];
    }
  }
  double all = 0;
  double tail = 0;
  for (std::size_t w = 0; w <= most; ++w) {
    all += ways[m][w];
    if (w <= static_cast<std::size_t>(u)) tail += ways[m][w];
  }
  return tail / all;
}

}  // namespace

PairedComparison compare_pairs(std::span<const double> a, std::span<const double> b,
                               const Bootstrap& bootstrap) {
  assert(a.size() == b.size() && !a.empty());
  PairedComparison found{};
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(a[i] - b[i]);
    ++(a[i] < b[i] ? found.a_less : a[i] > b[i] ? found.b_less : found.equal);
  }
  std::sort(differences.begin(), differences.end());
  found.median = median_of(differences);
  found.interval = bootstrap_interval(differences, median_of, bootstrap);
  found.sign_test_p = two_sided_sign_test(found.a_less, found.b_less);
  return found;
}

MannWhitney mann_whitney(std::span<const double> a, std::span<const double> b) {
  assert(!a.empty() && !b.empty());
  constexpr std::size_t kMostExact = 400;
  double u = 0;
  for (const double x : a) {
    for (const double y : b) u += x > y ? 1.0 : x == y ? 0.5 : 0.0;
  }
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  double ties = 0;  // sum of t³ - t over groups of t equal values
  for (auto first = all.begin(); first != all.end();) {
    const auto last = std::upper_bound(first, all.end(), *first);
    const auto t = static_cast<double>(last - first);
    ties += t * t * t - t;
    first = last;
  }

  const auto n = static_cast<double>(a.size());
  const auto m = static_cast<double>(b.size());
  const double less = std::min(u, n * m - u);
  if (ties == 0 && a.size() * b.size() <= kMostExact) {
    const double tail = exact_lower_tail(static_cast<int>(less), a.size(), b.size());
    return {u, std::min(1.0, 2 * tail)};
  }
  const double count = n + m;
  const double variance = n * m / 12 * (count + 1 - ties / (count * (count - 1)));
  if (variance <= 0) return {u, 1};  // all values are equal
  const double z = std::max(0.0, n * m / 2 - less - 0.5) / std::sqrt(variance);
  return {u, std::min(1.0, 2 * cdf(complement(boost::math::normal_distribution<>(), z)))};
}

}  // namespace bqsa::harness
