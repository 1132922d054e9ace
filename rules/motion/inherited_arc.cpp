// inherited-arc: axis words alone, without a centre, while G02 or G03 is in force.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::inherited_arc {
namespace {

class InheritedArc final : public FlowRule {
public:
  InheritedArc(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!view_.wasSet(state, ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
        !isLineByItself(node))
      return;
    const bool always =
        view_.surely(state, ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    const auto [at, isNew] = places_.emplace(node, always);
    at->second = at->second && (isNew || always);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, always] : places_) {
      const Word &word = *view_.modalMotionWords(node).front();
      const auto arc = arcBefore(node, facts);
      if (!always && !arc && readsContour(facts, context))
        continue; // of an arc within the contour, which ends otherwise
      reporter.report(
          {.message = fmt::format("`G02` or `G03` is still active at {}{}, but the block has neither `R` nor `I J K`",
                                  context.quoted(word.span()), always ? "" : " on some path"),
           .span = word.span(),
           .labels = arc ? std::vector<Label>{arc->label} : std::vector<Label>{},
           .flow = arc ? arc->flow : std::vector<Label>{},
           .notes = {fmt::format("the control {}{}", stopsWith(context.dialect, AlarmKind::ArcWithoutCentre),
                                 context.dialect.hasFanucParameters
                                     ? ", or moves in a straight line if parameter 3403#5 (CIR) is 0"
                                     : ""),
                     "for a straight move write G00 or G01 in this block"}},
          always ? Severity::Error : Severity::Warning);
    }
  }

private:
  bool isLineByItself(NodeId node) const {
    if (view_.modalMotionWords(node).empty() || view_.sets(node, ModalKind::Motion))
      return false;
    const auto words = view_.wordsOf(node);
    return std::ranges::none_of(words, [](const Word *word) {
      return std::string_view("IJKR").find(word->address()) != std::string_view::npos;
    });
  }
  /// Behind a cycle any code of its contour may be in force, as far as the analysis knows.
  static bool readsContour(const FlowFacts &facts, const FileContext &context) {
    const Program &program = context.model.programs[facts.program];
    for (BlockId block = program.first; block < program.last; block = block.next())
      if (findCode(context.tree, block, context.dialect, CodeRole::Contour))
        return true;
    return false;
  }
  struct ArcBefore {
    Label label;
    std::vector<Label> flow; // from the head of the program
  };
  /// The nearest arc in the text from which the node is reached without another code of motion.
  std::optional<ArcBefore> arcBefore(NodeId node, const FlowFacts &facts) const {
    const auto sets = [&](NodeId other) { return view_.sets(other, ModalKind::Motion); };
    for (NodeId arc = node; arc != facts.entry();) {
      arc = NodeId(arc.index() - 1);
      const Word *word = view_.findAction(arc, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
      const auto path = word && facts.isReached(arc) ? findPath(facts, arc, node, sets) : std::nullopt;
      if (!path)
        continue;
      std::vector<Label> all = pathFromEntry(facts, arc);
      std::ranges::move(describePath(facts, *path), std::back_inserter(all));
      return ArcBefore{{word->span(), "active since here"}, std::move(all)};
    }
    return std::nullopt;
  }

  MotionView view_;
  std::map<NodeId, bool> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<InheritedArc>(program, context);
}

} // namespace

extern const Rule inheritedArc;
const Rule inheritedArc{.info = {"inherited-arc", Category::Motion, Severity::Error,
                                 "Reports axis words without `R` and `I J K` in a block where an arc is still active."},
                        .hooks = {.watch = watch}};

} // namespace feedhold::rules::inherited_arc
