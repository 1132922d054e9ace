// call-in-wrong-mode: `G91` and then `G65P9100`, whose contract takes G90 for granted.
#include "language/dialect/code_name.h"
#include "rules/contract/contract_view.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace feedhold::rules::call_in_wrong_mode {
namespace {

/// A call in which another code than the one of a clause is in force.
struct Wrong {
  CallId call;
  ProgramRef callee;
  const ModalCode *wanted;
  CodeSet found; // over all runs that come to the call
};

class CallInWrongMode final : public FlowRule {
public:
  CallInWrongMode(ProgramId program, const FileContext &context) : context_(context), view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    const auto *instruction =
        std::get_if<CallProgram>(&context_.programs->file(context_.file).cfg.nodes[node].instruction);
    if (!instruction || isModal(context_.model.calls[instruction->call].kind))
      return;
    const auto callee = context_.programs->callee(context_.file, instruction->call);
    const Contract *contract = callee ? context_.contractOf({callee->file, callee->program}) : nullptr;
    if (!contract)
      return;
    for (std::size_t i = 0; i < contract->modal.size(); ++i) {
      const ModalCode &wanted = contract->modal[i];
      if (!indexOf(wanted))
        continue;
      // What the caller's own caller has in force is not known, nor what a program leaves that is not followed.
      const CodeSet found = isHavocked(state) ? CodeSet::atEntry() : state.codes[wanted.group];
      const Wrong seen{instruction->call, {callee->file, callee->program}, &wanted, found};
      const auto [at, isNew] = seen_.emplace(std::pair{node, i}, seen);
      if (!isNew)
        at->second.found = join(at->second.found, seen.found);
    }
  }

  void report(const FlowFacts &facts, const FileContext &, const Reporter &reporter) override {
    for (const auto &[place, wrong] : seen_) {
      const CodeMask others = wrong.found.codes() & ~(CodeMask{1} << *indexOf(*wrong.wanted));
      if (others == 0)
        continue;
      tell(place.first, wrong, others, facts, reporter);
    }
  }

private:
  void tell(NodeId node, const Wrong &wrong, CodeMask others, const FlowFacts &facts, const Reporter &reporter) const {
    const bool always = !wrong.found.mayBeAtEntry() && others == wrong.found.codes();
    const std::string wanted = spelled(wrong.wanted->tenths);
    Diagnostic diagnostic{.message = fmt::format("{} is called with {} active{}, but its contract requires {}",
                                                 nameOf(wrong.callee), namesOf(others, wrong.wanted->group),
                                                 always ? "" : " on some path", wanted),
                          .span = context_.model.calls[wrong.call].span};
    pointAtSetting(node, others, wrong.wanted->group, facts, diagnostic);
    pointAtContract(wrong.wanted->clause, wrong.callee.file, context_, diagnostic);
    diagnostic.notes.push_back(fmt::format("write {} before the call", wanted));
    reporter.report(std::move(diagnostic), always ? Severity::Error : Severity::Warning);
  }
  /// The nearest block in the text that puts one of the codes on and from which the call is reached with it.
  void pointAtSetting(NodeId call, CodeMask others, std::uint8_t group, const FlowFacts &facts,
                      Diagnostic &diagnostic) const {
    const auto sets = [&](NodeId node) { return wordOf(node, ~CodeMask{0}, group) != nullptr; };
    for (NodeId node = call; node != facts.entry();) {
      node = NodeId(node.index() - 1);
      const Word *word = facts.isReached(node) ? wordOf(node, others, group) : nullptr;
      const auto path = word ? findPath(facts, node, call, sets) : std::nullopt;
      if (!path)
        continue;
      diagnostic.labels.push_back({word->span(), "active since here"});
      diagnostic.flow = pathFromEntry(facts, node);
      std::ranges::move(describePath(facts, *path), std::back_inserter(diagnostic.flow));
      return;
    }
    diagnostic.flow = pathFromEntry(facts, call);
  }
  /// The word of the node with one of the codes of the group.
  const Word *wordOf(NodeId node, CodeMask codes, std::uint8_t group) const {
    for (const Word *word : view_.wordsOf(node)) {
      const Code *code = word->address() == 'G' ? codeOf(*word, context_.dialect) : nullptr;
      const auto index = code && code->group == group ? view_.modes().indexOf(*code) : std::nullopt;
      if (index && (codes >> *index & 1) != 0)
        return word;
    }
    return nullptr;
  }

  /// Such a macro is called after movements, in the mode of then.
  static bool isModal(CallKind kind) { return kind == CallKind::Modal || kind == CallKind::ModalEach; }

  std::optional<std::uint8_t> indexOf(const ModalCode &wanted) const {
    const Code *code = wanted.address == 'G' ? findGCode(context_.dialect, wanted.tenths) : nullptr;
    return code && code->group == wanted.group ? view_.modes().indexOf(*code) : std::nullopt;
  }
  std::string nameOf(ProgramRef program) const {
    return toString(context_.callGraph.model(program.file).programs[program.program].name);
  }
  static std::string spelled(std::uint16_t tenths) { return fmt::format("`{}`", codeName('G', tenths)); }
  std::string namesOf(CodeMask codes, std::uint8_t group) const {
    std::string names;
    const auto &rows = view_.modes().group(group).codes;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if ((codes >> i & 1) != 0)
        names += (names.empty() ? "" : " or ") + spelled(rows[i]->tenths);
    return names;
  }

  const FileContext &context_;
  MotionView view_;
  std::map<std::pair<NodeId, std::size_t>, Wrong> seen_; // by place and clause
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CallInWrongMode>(program, context);
}

} // namespace

extern const Rule callInWrongMode;
const Rule callInWrongMode{.info = {"call-in-wrong-mode", Category::Contract, Severity::Error,
                                    "Reports a call in another mode than the contract of the called program requires."},
                           .hooks = {.watch = watch}};

} // namespace feedhold::rules::call_in_wrong_mode
