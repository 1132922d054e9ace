#include "proof/explore/merging.h"

#include <algorithm>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// Those of the first that the second lacks.
std::vector<TermId> without(const std::vector<TermId> &first, const std::vector<TermId> &second) {
  std::vector<TermId> sorted = second;
  std::sort(sorted.begin(), sorted.end());
  std::vector<TermId> rest;
  std::copy_if(first.begin(), first.end(), std::back_inserter(rest),
               [&](TermId condition) { return !std::binary_search(sorted.begin(), sorted.end(), condition); });
  return rest;
}

/// Of a value (smt::TermShape): a few choices between sums.
constexpr std::uint32_t kLargestValue = 60;

void forgetLarge(SymbolicInterpretation &interpretation, SymbolicState &state) {
  const smt::TermStore &store = interpretation.store();
  const auto isLarge = [&](TermId term) { return store.shape(term).size > kLargestValue; };
  forEachPart(Overloaded{[&](PartId, SymbolicValue &value) {
                           if (isLarge(value.vacant) || isLarge(value.number))
                             value =
                                 value.vacant == store.no() ? interpretation.anyNumber() : interpretation.anything();
                         },
                         [&](PartId, SymbolicCode &code) {
                           if (isLarge(code.index))
                             code = interpretation.unknownCode();
                         },
                         [&](PartId, Condition &truth) {
                           if (isLarge(truth.term))
                             truth = interpretation.unknownTruth();
                         }},
              state);
}

/// True on the second path and false on the first.
TermId selectorOf(SymbolicInterpretation &interpretation, const std::vector<TermId> &onlyFirst,
                  const std::vector<TermId> &onlySecond) {
  for (const TermId condition : onlySecond) {
    const TermId opposite = interpretation.store().logicalNot(condition);
    if (std::find(onlyFirst.begin(), onlyFirst.end(), opposite) != onlyFirst.end())
      return condition;
  }
  return interpretation.unknownTruth().term;
}

} // namespace

bool canMerge(const Path &a, const Path &b) {
  return a.at == b.at && a.frames == b.frames && a.loops == b.loops && !a.atOpenedHead && !b.atOpenedHead &&
         haveSameModalCalls(a.state, b.state);
}

void mergeInto(SymbolicInterpretation &interpretation, Path &path, Path other) {
  smt::TermStore &store = interpretation.store();
  const std::vector<TermId> onlyFirst = without(path.conditions, other.conditions);
  const std::vector<TermId> onlySecond = without(other.conditions, path.conditions);
  const TermId second = selectorOf(interpretation, onlyFirst, onlySecond);
  const TermId first = store.logicalNot(second);
  path.conditions = without(path.conditions, onlyFirst);
  for (const TermId condition : onlyFirst)
    if (condition != first)
      path.conditions.push_back(store.implies(first, condition));
  for (const TermId condition : onlySecond)
    if (condition != second)
      path.conditions.push_back(store.implies(second, condition));
  interpretation.join(path.state, {second}, other.state);
  path.moved = store.ite(second, other.moved, path.moved);
  path.steps = std::max(path.steps, other.steps);
}

void mergeAndForget(SymbolicInterpretation &interpretation, Path &path, Path other) {
  const std::vector<TermId> onlyFirst = without(path.conditions, other.conditions);
  std::vector<TermId> common = without(path.conditions, onlyFirst);
  mergeInto(interpretation, path, std::move(other));
  path.conditions = std::move(common);
  forgetLarge(interpretation, path.state);
}

// ---- Worklist ----

void Worklist::add(Position position, Path path) {
  position.push_back(~std::uint32_t{0}); // who is deeper in a call comes first
  paths_[std::move(position)].push_back(std::move(path));
  ++size_;
}

std::optional<Callee> Worklist::busiestProgram() const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> counts; // by file and program
  std::optional<Callee> busiest;
  std::size_t most = 0;
  for (const auto &[position, paths] : paths_)
    for (const Path &path : paths) {
      const Callee &callee = path.frames.back().callee;
      if (const std::size_t count = ++counts[{callee.file.index(), callee.program.index()}]; count > most) {
        most = count;
        busiest = callee;
      }
    }
  return busiest;
}

std::vector<Path> Worklist::takeFirst() {
  auto node = paths_.extract(paths_.begin());
  size_ -= node.mapped().size();
  return std::move(node.mapped());
}

} // namespace feedhold::prove
