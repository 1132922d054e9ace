// reference-through-work-zero: `G90 G28 Z0.`, and `G28 X0.` on a lathe.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace feedhold::rules::reference_through_work_zero {
namespace {

/// `Z0` makes the tool dive.  `X0` and `Y0` are a habit of some, on which only those who write `G91` elsewhere agree
/// that it is a mistake.
class ReferenceThroughWorkZero final : public FlowRule {
public:
  ReferenceThroughWorkZero(ProgramId program, const FileContext &context)
      : view_(program, context),
        hasLetters_(context.dialect.machine == MachineKind::Turning && !view_.modes().groupOf(ModalKind::Distance)) {}

  void after(NodeId node, const AbstractState &state) override {
    if (zeroWords(node).empty() || statesIncrements(node))
      return;
    const bool isKnown = !isHavocked(state);
    const Modes modes{hasLetters_ || (isKnown && view_.surely(state, ModalKind::Distance, {CodeAction::Absolute})),
                      isKnown && view_.surely(state, ModalKind::Distance, {CodeAction::Incremental})};
    const auto [at, isNew] = places_.emplace(node, modes);
    if (!isNew)
      at->second = {at->second.absolute && modes.absolute, at->second.incremental && modes.incremental};
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (hasLetters_)
      return reportOfLathe(reporter);
    for (const auto &[node, modes] : places_) {
      const Word *word = modes.absolute ? wrongWord(node) : nullptr;
      if (!word)
        continue;
      const bool dives = word->address() == 'Z';
      reporter.report(
          {.message =
               fmt::format("{} under `G90` makes part zero the intermediate point", context.quoted(word->span())),
           .span = word->span(),
           .flow = pathFromEntry(facts, node),
           .notes = {dives ? "the tool moves down to Z0 at rapid before it goes to the reference point"
                           : "the axis moves to part zero at rapid before it goes to the reference point; the other "
                             "returns of this axis in the program stand under G91",
                     "write G91 in this block: the intermediate point is then the current position"},
           .fixes = {fixFor(node, *word)}});
    }
  }

private:
  struct Modes {
    bool absolute;
    bool incremental;
  };

  /// U0 and W0 are the current position.  A Z that returns alone passes beside the part if X has returned before.
  void reportOfLathe(const Reporter &reporter) const {
    for (const auto &[node, modes] : places_) {
      const auto words = zeroWords(node);
      const auto across = std::ranges::find(words, 'X', [](const Word *word) { return word->address(); });
      const Word &word = across == words.end() ? *words.front() : **across;
      if (word.address() == 'Y')
        continue;
      const bool isAcross = word.address() == 'X';
      Diagnostic diagnostic{
          .message = fmt::format("{} makes {} the intermediate point", view_.context().quoted(word.span()),
                                 isAcross ? "the centre line" : "part zero"),
          .span = word.span(),
          .notes = {isAcross ? "the tool moves to the centre line at rapid, through the part, before it goes to the "
                               "reference point"
                             : "the tool moves to Z0 at rapid before it goes to the reference point",
                    isAcross ? "write `U0`: the intermediate point is then the current position"
                             : "write `W0`: the intermediate point is then the current position"}};
      FixIt fix{.title = "write the distances `U`, `W`", .edits = {}};
      for (const Word *each : words)
        if (each->address() != 'Y')
          fix.edits.push_back({{each->span().begin, each->span().begin + 1}, each->address() == 'X' ? "U" : "W"});
      diagnostic.fixes.push_back(std::move(fix));
      reporter.report(std::move(diagnostic), isAcross ? Severity::Warning : Severity::Info);
    }
  }
  FixIt fixFor(NodeId node, const Word &word) const {
    if (const Word *absolute = view_.findAction(node, {CodeAction::Absolute}))
      return {.title = "write `G91`", .edits = {{absolute->span(), "G91"}}};
    return {.title = "insert `G91`", .edits = {{{word.span().begin, word.span().begin}, "G91"}}};
  }
  /// `G91` of a lathe whose codes the text does not settle: in system B and C it says what is meant.
  bool statesIncrements(NodeId node) const {
    const auto words = view_.context().tree.wordsOf(view_.node(node).block);
    return hasLetters_ &&
           std::ranges::any_of(words, [](const Word &word) { return word.address() == 'G' && word.integer() == 91U; });
  }
  std::vector<const Word *> zeroWords(NodeId node) const {
    std::vector<const Word *> words;
    if (!view_.findAction(node, {CodeAction::ReferenceReturn, CodeAction::SecondReference}))
      return words;
    for (const Word *word : view_.wordsOf(node))
      if (std::string_view("XYZ").find(word->address()) != std::string_view::npos && word->isNumber() &&
          word->number().isZero())
        words.push_back(word);
    return words;
  }
  const Word *wrongWord(NodeId node) const {
    const auto words = zeroWords(node);
    for (const Word *word : words)
      if (word->address() == 'Z')
        return word;
    const auto isHabit = [&](const Word *word) { return isIncrementalElsewhere(word->address()); };
    const auto found = std::ranges::find_if(words, isHabit);
    return found == words.end() ? nullptr : *found;
  }
  /// Two returns of the axis under G91 and more, and no second one under G90.
  bool isIncrementalElsewhere(char axis) const {
    int incremental = 0;
    int absolute = 0;
    for (const auto &[node, modes] : places_) {
      const bool moves =
          std::ranges::any_of(zeroWords(node), [&](const Word *word) { return word->address() == axis; });
      incremental += moves && modes.incremental ? 1 : 0;
      absolute += moves && modes.absolute ? 1 : 0;
    }
    return incremental >= 2 && absolute == 1;
  }

  MotionView view_;
  bool hasLetters_; // distances are U and W: X and Z are never distances
  std::map<NodeId, Modes> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ReferenceThroughWorkZero>(program, context);
}

} // namespace

extern const Rule referenceThroughWorkZero;
const Rule referenceThroughWorkZero{
    .info = {"reference-through-work-zero", Category::Motion, Severity::Warning,
             "Reports a reference return with `Z0` while `G90` is active or with `X0` on a lathe, and one with `X0` or "
             "`Y0` where the other returns of the axis stand under `G91`."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::reference_through_work_zero
