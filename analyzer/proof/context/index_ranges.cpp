#include "proof/context/index_ranges.h"

#include "inference/absint/analysis.h"
#include "meaning/cfg/reached_programs.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace feedhold::prove {

namespace {

constexpr std::uint64_t kMostInstructions = 300'000; // of the analysis

using IndexExpressions = std::map<std::pair<std::uint32_t, std::uint32_t>, IndexPlace>; // by file and expression

void addIndices(const ProgramFile &file, IndexExpressions &indices) {
  for (const Expression &expression : file.tree->expressions)
    if (const auto *variable = std::get_if<IndirectVariable>(&expression.node))
      indices.emplace(std::pair{file.file.index(), variable->index.index()},
                      IndexPlace{file.file.index(), expression.span.begin});
}

/// The variables that a number of the interval chooses.
VariableSpan chosenBy(const Interval &interval) {
  constexpr double kMost = 0xffffffff;
  const auto nearest = [&](double number) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(number + 0.5), 0.0, kMost));
  };
  return {nearest(interval.lo), nearest(interval.hi)};
}

class IndexCollector : public AnalysisVisitor {
public:
  explicit IndexCollector(const IndexExpressions &indices) : indices_(indices) {}

  void visit(Place place, const AbstractState &, std::span<const Place>) override { place_ = place; }
  void resumed(Place place, std::span<const Place>) override { place_ = place; }
  void evaluated(ExpressionId expression, const AbstractValue &value) override {
    const auto index = indices_.find({place_.file.index(), expression.index()});
    if (index == indices_.end())
      return;
    Interval number = value.mayBeNumber() ? value.number().interval() : Interval{0, 0};
    if (value.mayBeVacant()) // it counts as 0
      number = {std::min(number.lo, 0.0), std::max(number.hi, 0.0)};
    const auto [known, isNew] = intervals_.emplace(index->second, number);
    known->second = {std::min(known->second.lo, number.lo), std::max(known->second.hi, number.hi)};
  }

  IndexRanges ranges() const {
    IndexRanges ranges;
    for (const auto &[place, interval] : intervals_)
      if (const VariableSpan span = chosenBy(interval); span.last > 0 && (span.first > 1 || span.last < 0xffffffff))
        ranges.emplace(place, span);
    return ranges;
  }

private:
  const IndexExpressions &indices_;
  Place place_{FileId(0), NodeId(0)};
  std::map<IndexPlace, Interval> intervals_;
};

} // namespace

IndexRanges indexRangesOf(const ProgramSet &programs, Callee program, const FileContracts *contracts) {
  ReachedPrograms reached;
  collectReached(programs, {program.file, program.program}, reached);
  std::set<std::uint32_t> files;
  for (const ProgramRef &each : reached.programs)
    files.insert(each.file.index());
  IndexExpressions indices;
  for (const std::uint32_t file : files)
    addIndices(programs.file(FileId(file)), indices);
  if (indices.empty())
    return {};
  Analysis analysis(programs, {.budget = kMostInstructions});
  IndexCollector collector(indices);
  analysis.walk(program, analysis.entryState(program, contracts), collector);
  return analysis.gaveUp() ? IndexRanges() : collector.ranges();
}

} // namespace feedhold::prove
