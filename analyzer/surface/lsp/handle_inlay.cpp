// What stands between the lines: names of arguments, bounds of loops, G90 and G91 where they change unseen.
#include "meaning/semantics/modal_table.h"
#include "surface/lsp/feature_arguments.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_meaning.h"
#include "surface/sink/ranges_facts.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

constexpr int kType = 1; // InlayHintKind
constexpr int kParameter = 2;

class Hints {
public:
  Hints(const View &view, Span wanted) : view_(view), programs_(*view.programs), file_(view.file()), wanted_(wanted) {}

  Json build() {
    for (const Call &call : file_.model.calls)
      arguments(call);
    if (view_.proofs)
      for (const DocumentProof &each : *view_.proofs)
        for (const prove::Obligation &obligation : each.proof.obligations)
          bound(obligation);
    distances();
    return std::move(hints_);
  }

private:
  void add(std::uint32_t offset, const std::string &label, int kind) {
    if (offset < wanted_.begin || offset > wanted_.end)
      return;
    Json hint{{"position", view_.places().position(offset)}, {"label", label}, {"kind", kind}};
    hint[kind == kParameter ? "paddingRight" : "paddingLeft"] = true;
    hints_.push_back(std::move(hint));
  }
  void arguments(const Call &call) {
    const Span block = file_.tree.blocks[call.block].span();
    if (call.arguments.empty() || block.end < wanted_.begin || block.begin > wanted_.end)
      return;
    const auto callee = programs_.set->callGraph().callee(kDocument, call);
    if (!callee)
      return;
    for (const Argument &argument : call.arguments)
      if (argument.variable != 0 && argument.role == ArgumentRole::Passed)
        if (const std::string name = meaningOf(programs_, *callee, argument.variable); !name.empty())
          add(file_.tree.words[argument.word].span().begin, name + ":", kParameter);
  }
  void bound(const prove::Obligation &obligation) {
    if (obligation.verdict.bound().empty() || obligation.place.file != kDocument)
      return;
    const BlockId block = programs_.set->node(obligation.place).block;
    add(file_.tree.blocks[block].end, fmt::format("at most {} iterations", obligation.verdict.bound()), kType);
  }

  // ---- G90 and G91 ----

  void distances() {
    const auto group = ModalTable(programs_.dialect()).groupOf(ModalKind::Distance);
    const BlockId first = file_.tree.blockAt(wanted_.begin), last = file_.tree.blockAt(wanted_.end);
    if (!group || !mayChangeUnseen(*group))
      return;
    const BlockStates *states = view_.flow->statesSoon(view_.programs);
    if (!states)
      return;
    std::optional<std::pair<BlockId, CodeSet>> before;
    for (const auto &[block, codes] : codesIn(*states, *group, first, last)) {
      const bool follows = before && isSameProgram(before->first, block);
      if (follows && before->second != codes && !setsDistance(before->first, *group))
        add(file_.tree.blocks[block].end, textOf(codes, *group) + " active here", kType);
      before = {block, codes};
    }
  }
  /// What may be in force before the blocks of a range and the one above it, over all chains of calls.
  std::map<BlockId, CodeSet> codesIn(const BlockStates &states, std::uint8_t group, BlockId first, BlockId last) const {
    std::map<BlockId, CodeSet> codes;
    for (const ContextStates &context : states.contexts) {
      if (context.file != kDocument)
        continue;
      auto at = context.blocks.lower_bound(first);
      if (at != context.blocks.begin())
        --at;
      for (; at != context.blocks.end() && at->first <= last; ++at) {
        const CodeSet here = at->second.code(group);
        const auto [known, isNew] = codes.emplace(at->first, here);
        if (!isNew)
          known->second = join(known->second, here);
      }
    }
    return codes;
  }
  bool isSameProgram(BlockId a, BlockId b) const { return file_.model.programOf(a) == file_.model.programOf(b); }
  /// Only a jump or a call can bring another state to a block than the one above it leaves.
  bool mayChangeUnseen(std::uint8_t group) const {
    const bool leads = !file_.model.jumps.empty() || !file_.model.loops.empty() || !file_.model.calls.empty();
    return leads && std::any_of(file_.tree.words.begin(), file_.tree.words.end(),
                                [&](const Word &word) { return isDistance(word, group); });
  }
  bool isDistance(const Word &word, std::uint8_t group) const {
    const auto tenths = word.address() == 'G' ? word.tenths() : std::nullopt;
    const Code *code = tenths ? findGCode(programs_.dialect(), *tenths) : nullptr;
    return code && code->group == group;
  }
  bool setsDistance(BlockId block, std::uint8_t group) const {
    const auto words = file_.tree.wordsOf(block);
    return std::any_of(words.begin(), words.end(), [&](const Word &word) { return isDistance(word, group); });
  }
  std::string textOf(const CodeSet &codes, std::uint8_t group) const {
    const ModalTable modes(programs_.dialect());
    const auto &rows = modes.group(group).codes;
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (codes.contains(i))
        text += fmt::format("{}G{}", text.empty() ? "" : " or ", rows[i]->tenths / 10);
    if (codes.mayBeAtEntry())
      text += text.empty() ? "as at start" : " or as at start";
    return text;
  }

  const View &view_;
  const Project &programs_;
  const ProjectFile &file_;
  Span wanted_;
  Json hints_ = Json::array();
};

} // namespace

Json inlayHint(const View &view, const Json &params) {
  return Hints(view, view.places().span(params.at("range"))).build();
}

} // namespace feedhold::lsp
