#include "harness/outcome_message.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace bqsa::harness {
namespace {

class Writer {
 public:
  template <typename Number>
  void number(const Number& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void count(std::size_t& size) { number(size); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  void number(Number& value) {
    if (bytes_.size() < sizeof value) return fail();
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
  }
  /// Of elements of at least one byte each, so that no count asks for more than there is.
  void count(std::size_t& size) {
    number(size);
    if (size <= bytes_.size()) return;
    fail();
    size = 0;
  }
  void fail() {
    whole_ = false;
    bytes_ = {};
  }
  bool whole() const { return whole_ && bytes_.empty(); }

 private:
  std::string_view bytes_;
  bool whole_ = true;
};

template <typename Archive, typename Number>
requires std::is_arithmetic_v<Number>
void transfer(Archive& archive, Number& value) { archive.number(value); }

template <typename Archive, typename Enum>
requires std::is_enum_v<Enum>
void transfer_enum(Archive& archive, Enum& value, Enum last) {
  int number = static_cast<int>(value);
  archive.number(number);
  if constexpr (std::is_same_v<Archive, Reader>) {
    if (number < 0 || number > static_cast<int>(last)) return archive.fail();
    value = static_cast<Enum>(number);
  }
}

template <typename Archive>
void transfer(Archive& archive, std::string& text) {
  std::size_t size = text.size();
  archive.count(size);
  text.resize(size);
  for (char& letter : text) archive.number(letter);
}

template <typename Archive>
void transfer(Archive& archive, JointVector& q) {
  auto size = static_cast<std::size_t>(q.size());
  archive.count(size);
  if constexpr (std::is_same_v<Archive, Reader>) {
    if (size > kMaxJoints) return archive.fail();
  }
  q.resize(static_cast<Eigen::Index>(size));
  for (double& angle : q) archive.number(angle);
}

template <typename Archive>
void transfer(Archive& archive, ClampedPair& pair) {
  archive.number(pair.link);
  archive.number(pair.obstacle);
  archive.number(pair.ticks);
}

template <typename Archive, typename Element>
void transfer(Archive& archive, std::vector<Element>& list) {
  std::size_t size = list.size();
  archive.count(size);
  list.resize(size);
  for (Element& element : list) transfer(archive, element);
}

template <typename Archive>
void transfer(Archive& archive, LogHistogram& histogram) {
  std::size_t size = histogram.counts().size();
  archive.count(size);
  if constexpr (std::is_same_v<Archive, Writer>) {
    for (const auto& [bin, count] : histogram.counts()) {
      archive.number(bin);
      archive.number(count);
    }
  } else {
    for (std::size_t i = 0; i < size; ++i) {
      int bin = 0;
      std::int64_t count = 0;
      archive.number(bin);
      archive.number(count);
      histogram.add_bin(bin, count);
    }
  }
}

template <typename Archive>
void transfer(Archive& archive, RunTimes& times) {
  for (double* seconds : {&times.construct_s, &times.prepare_s, &times.plan_s, &times.first_step_s,
                          &times.warm_median_s, &times.warm_p99_s, &times.warm_p999_s,
                          &times.warm_max_s, &times.run_s, &times.cpu_s, &times.hidden_cpu_s}) {
    archive.number(*seconds);
  }
  archive.number(times.warm_steps);
  archive.number(times.warm_max_tick);
  transfer(archive, times.warm_max_q);
  transfer(archive, times.warm_histogram);
}

template <typename Archive>
void transfer(Archive& archive, TickIncrements& increments) {
  archive.number(increments.mean);
  archive.number(increments.median);
  archive.number(increments.p99);
  archive.number(increments.max);
  transfer(archive, increments.histogram);
}

/// All that an outcome holds, for both directions.
template <typename Archive>
void transfer(Archive& archive, RunOutcome& outcome) {
  transfer_enum(archive, outcome.claim, Claim::kOutOfMemory);
  archive.number(outcome.tick);
  transfer_enum(archive, outcome.reason, Infeasible::kDiverged);
  archive.number(outcome.link);
  archive.number(outcome.obstacle);
  transfer(archive, outcome.message);
  archive.number(outcome.inputs_changed);
  archive.number(outcome.work_hidden);
  archive.number(outcome.killed);
  archive.number(outcome.free_ticks);
  archive.number(outcome.clamped_ticks);
  archive.number(outcome.unclaimed_ticks);
  archive.number(outcome.guard_fired);
  transfer(archive, outcome.clamped_pairs);
  archive.number(outcome.clamp_starts);
  archive.number(outcome.increments_total);
  archive.number(outcome.increments_max);
  transfer(archive, outcome.increments);
  archive.number(outcome.counters);
  transfer(archive, outcome.times);
  transfer(archive, outcome.trajectory.t);
  transfer(archive, outcome.trajectory.q);
}

}  // namespace

std::string outcome_message(const RunOutcome& outcome) {
  Writer writer;
  RunOutcome copy = outcome;
  transfer(writer, copy);
  return writer.take();
}

std::optional<RunOutcome> read_outcome_message(std::string_view bytes) {
  Reader reader(bytes);
  RunOutcome outcome;
  transfer(reader, outcome);
  if (!reader.whole()) return std::nullopt;
  return outcome;
}

}  // namespace bqsa::harness
