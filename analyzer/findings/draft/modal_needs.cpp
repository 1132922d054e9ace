// See the header.
#include "findings/draft/modal_needs.h"

#include "findings/draft/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostCallers = 8;
constexpr std::size_t kMostNodesOfCaller = 20'000;

/// The first block that moves an axis in a distance mode that the program has not set.
class DistanceWatch : public FlowWatch {
public:
  DistanceWatch(const ProgramFile &file, std::uint8_t group) : file_(file), group_(group) {}
  void move(NodeId node, MoveKind kind) override {
    isMove_ = node;
    isCut_ = kind != MoveKind::Dwell && kind != MoveKind::Unmodelled;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (isMove_ != node || !isCut_ || state.codes[group_].only() || !hasAxis(node))
      return;
    first_ = first_ ? std::min(*first_, node) : node;
  }
  std::optional<NodeId> first() const { return first_; }

private:
  bool hasAxis(NodeId node) const {
    return std::ranges::any_of(file_.tree->wordsOf(file_.cfg.nodes[node].block), [](const Word &word) {
      return std::string_view("XYZABC").find(word.address()) != std::string_view::npos && !word.has(Word::kArgument);
    });
  }

  const ProgramFile &file_;
  std::uint8_t group_;
  std::optional<NodeId> isMove_;
  bool isCut_ = false;
  std::optional<NodeId> first_;
};

/// The codes of a group at the calls of a program.
class CallWatch : public FlowWatch {
public:
  CallWatch(std::vector<CallId> calls, const ProgramFile &file, std::uint8_t group)
      : calls_(std::move(calls)), file_(file), group_(group) {}
  void before(NodeId node, const AbstractState &state) override {
    const auto *call = std::get_if<CallProgram>(&file_.cfg.nodes[node].instruction);
    if (call && std::ranges::find(calls_, call->call) != calls_.end())
      codes_.insert(state.codes[group_].only());
  }
  const std::set<std::optional<std::uint8_t>> &codes() const { return codes_; }

private:
  std::vector<CallId> calls_;
  const ProgramFile &file_;
  std::uint8_t group_;
  std::set<std::optional<std::uint8_t>> codes_;
};

struct CallersCode {
  std::optional<std::uint8_t> code; // in force at all calls
  std::size_t calls = 0;
};

CallersCode codeOfCallers(const FlowFacts &facts, std::uint8_t group) {
  const ProgramSet &set = facts.programs;
  std::map<ProgramRef, std::vector<CallId>> callers;
  CallersCode found;
  for (const CallGraph::Caller &caller : set.callGraph().callers({facts.file.file, facts.program})) {
    callers[{caller.file, set.file(caller.file).model->calls[caller.call].caller}].push_back(caller.call);
    ++found.calls;
  }
  if (callers.empty() || callers.size() > kMostCallers)
    return found;
  std::set<std::optional<std::uint8_t>> codes;
  for (const auto &[caller, calls] : callers) {
    const ProgramFile &file = set.file(caller.file);
    if (file.cfg.nodes.size() > kMostNodesOfCaller)
      return found;
    CallWatch watch(calls, file, group);
    FlowWatch *watches[] = {&watch};
    if (!collectFacts(set, caller.file, caller.program, watches).isComplete())
      return found;
    codes.insert(watch.codes().begin(), watch.codes().end());
  }
  if (codes.size() == 1)
    found.code = *codes.begin();
  return found;
}

} // namespace

DraftClauses modalNeeds(const FlowFacts &facts, const FileContracts &contracts) {
  const auto group = facts.modes.groupOf(ModalKind::Distance);
  if (!group || !facts.isComplete() || !comesBack(facts))
    return {};
  DistanceWatch watch(facts.file, *group);
  FlowWatch *watches[] = {&watch};
  collectFacts(facts.programs, facts.file.file, facts.program, watches, &contracts);
  if (!watch.first())
    return {};
  const std::uint32_t line = facts.file.source->lineOf(facts.file.tree->blocks[facts.node(*watch.first()).block].begin);
  const CallersCode callers = codeOfCallers(facts, *group);
  const auto &codes = facts.modes.group(*group).codes;
  if (callers.code && *callers.code < codes.size())
    return {{fmt::format("@MODAL G{}", codes[*callers.code]->tenths / 10),
             fmt::format("line {} moves in the mode of the caller; it is active at {}", line,
                         callers.calls == 1 ? "the only call" : fmt::format("all {} calls", callers.calls)),
             Ground::Notes}};
  return {{"@MODAL G90", fmt::format("line {} moves in the mode of the caller, G90 or G91", line), Ground::Hint}};
}

} // namespace feedhold::draft
