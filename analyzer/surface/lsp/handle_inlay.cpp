// What stands between the lines: names of arguments, bounds of loops, G90 and G91 where they change unseen.
#include "findings/session/ranges.h"
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
/// The flow of longer programs is not followed for hints: they are asked for with every change.
constexpr std::size_t kMostBlocksFollowed = 500;

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
    if (obligation.bound.empty() || obligation.place.file != kDocument || !prove::holds(obligation.verdict))
      return;
    const BlockId block = programs_.set->node(obligation.place).block;
    add(file_.tree.blocks[block].end, fmt::format("at most {} passes", obligation.bound), kType);
  }

  // ---- G90 and G91 ----

  void distances() {
    const ModalTable modes(programs_.dialect);
    const auto group = modes.groupOf(ModalKind::Distance);
    if (!group || file_.tree.blockCount() > kMostBlocksFollowed || !mayChangeUnseen(*group))
      return;
    const Result<BlockStates> states = rangesOf(programs_, {});
    if (!states || states.value().gaveUp)
      return;
    std::map<BlockId, std::string> codes;
    for (const ContextStates &context : states.value().contexts)
      if (context.file == kDocument)
        for (const auto &[block, state] : context.blocks)
          note(codes[block], state.codes[*group], modes.group(*group));
    const std::string *before = nullptr;
    std::optional<BlockId> last;
    for (const auto &[block, code] : codes) {
      if (before && *before != code && !setsDistance(*last, *group))
        add(file_.tree.blocks[block].end, code + " before this block", kType);
      before = &code;
      last = block;
    }
  }
  /// Only a jump or a call can bring another state to a block than the one above it leaves.
  bool mayChangeUnseen(std::uint8_t group) const {
    const bool leads = !file_.model.jumps.empty() || !file_.model.loops.empty() || !file_.model.calls.empty();
    return leads && std::any_of(file_.tree.words.begin(), file_.tree.words.end(),
                                [&](const Word &word) { return isDistance(word, group); });
  }
  bool isDistance(const Word &word, std::uint8_t group) const {
    const auto tenths = word.address() == 'G' ? word.tenths() : std::nullopt;
    const Code *code = tenths ? findGCode(programs_.dialect, *tenths) : nullptr;
    return code && code->group == group;
  }
  bool setsDistance(BlockId block, std::uint8_t group) const {
    const auto words = file_.tree.wordsOf(block);
    return std::any_of(words.begin(), words.end(), [&](const Word &word) { return isDistance(word, group); });
  }
  /// Adds what is in force on one more way.
  static void note(std::string &text, const CodeSet &set, const ModalGroup &group) {
    const auto name = [&](std::size_t i) { return fmt::format("G{}", group.codes[i]->tenths / 10); };
    std::vector<std::string> found;
    for (std::size_t i = 0; i < group.codes.size(); ++i)
      if (set.contains(i))
        found.push_back(name(i));
    if (set.mayBeAtEntry())
      found.emplace_back("that of the start");
    for (const std::string &each : found)
      if (text.find(each) == std::string::npos)
        text += (text.empty() ? "" : " or ") + each;
  }

  const View &view_;
  const LoadedPrograms &programs_;
  const LoadedFile &file_;
  Span wanted_;
  Json hints_ = Json::array();
};

} // namespace

Json inlayHint(const View &view, const Json &params) {
  return Hints(view, view.places().span(params.at("range"))).build();
}

} // namespace feedhold::lsp
