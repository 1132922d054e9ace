// Partitions: the states of one place, kept apart by what later jumps depend on: G90 or G91, and the small discrete
// variables by which a program dispatches (`IF[#131 EQ 1]GOTO100`).
#pragma once

#include "inference/absint/abstract_state.h"
#include "inference/absint/loop_counters.h"

#include <optional>
#include <span>
#include <vector>

namespace feedhold {

/// By what the states of a program are kept apart.
struct PartitionBy {
  std::optional<std::uint8_t> distanceGroup;
  std::vector<std::uint32_t> variables; // compared for equality with constants, or jumped by; at most kMostVariables
  static constexpr std::size_t kMostVariables = 3;
};

/// Found in the text of a program.
PartitionBy partitionBy(const ProgramFile &file, ProgramId program, const ModalTable &modes);

/// Equal for states that belong together; 0 for those of which nothing is known.
std::uint64_t keyOf(const PartitionBy &by, const AbstractInterpretation &interpretation, const AbstractState &state);

/// How the states at the head of a loop grow.
struct Growth {
  bool widening; // else they are joined
  std::span<const double> thresholds;
  const LoopCounters &counters;
};

class Partitions {
public:
  static constexpr std::size_t kMost = 12; // then all are joined

  struct Part {
    std::uint64_t key;
    AbstractState state;
  };
  bool empty() const { return parts_.empty(); }
  std::vector<Part> &parts() { return parts_; }
  const std::vector<Part> &parts() const { return parts_; }

  void add(AbstractInterpretation &interpretation, std::uint64_t key, AbstractState &&state);
  /// Old states that grow are joined or widened, new ones are taken as they are; true when anything has changed.
  bool grow(AbstractInterpretation &interpretation, const Partitions &incoming, const Growth &how);
  /// What has arrived in place of what was assumed, part by part, where it says more.
  Partitions narrowedBy(const AbstractInterpretation &interpretation, const Partitions &incoming) const;
  /// Every state is within one of `other` of its key.
  bool within(const AbstractInterpretation &interpretation, const Partitions &other) const;

private:
  Part *find(std::uint64_t key);
  const Part *find(std::uint64_t key) const { return const_cast<Partitions *>(this)->find(key); }
  void merge(AbstractInterpretation &interpretation);

  std::vector<Part> parts_; // by key
  bool merged_ = false;     // too many: there is one part for all
};

} // namespace feedhold
