// spindle-not-started: a cutting move of a main program with the spindle at rest.
#include "rules/motion/motion_view.h"
#include "rules/motion/turning_walk.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace feedhold::rules::spindle_not_started {
namespace {

class SpindleNotStarted final : public FlowRule {
public:
  SpindleNotStarted(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(startedBy(context, program) == StartedBy::Operator),
        isLathe_(context.dialect.machine == MachineKind::Turning) {}

  void before(NodeId node, const AbstractState &state) override {
    if (asked_ && (view_.mayHave(node, 'X') || view_.mayHave(node, 'Y') || view_.mayHave(node, 'Z')))
      start_ = state.position;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    mayBeStartedUnseen_ = mayBeStartedUnseen_ || hasOtherSpindleCode(node);
    // A lathe pulls bars, and taps, with the spindle stopped.
    if (!state.spindle.mayBeAtEntry() && (isLathe_ || !state.spindle.contains(kStopped)))
      return;
    if (isHavocked(state))
      return;
    if (isLathe_ && threadIn(node))
      return thread_.note(node);
    if (!movesTool(node) || !cuts(state) || isAbovePart(node, state) || standsStill(node, state))
      return;
    first_.note(node);
    if (drills(state))
      hole_.note(node);
    if (drills(state) || (!isLathe_ && goesBelowZero(node, state)))
      intoPart_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (mayBeStartedUnseen_ || (isLathe_ ? !isOfLathe(facts) : !isOfMill(facts)))
      return;
    const Span place = placeOf(*first_.node());
    const std::string move = context.quoted(place);
    Diagnostic diagnostic{
        .message = {}, .span = place, .notes = {"the tool is fed into the part with the spindle stopped"}};
    if (const auto stop = isLathe_ ? std::nullopt : stopBefore(facts)) {
      diagnostic.message = fmt::format("the spindle is stopped at the cutting move to {}", move);
      diagnostic.labels = {{view_.findAction(stop->node, {CodeAction::SpindleStop})->span(), "stopped here"}};
      diagnostic.flow = describePath(facts, stop->path);
      diagnostic.notes.push_back("start it again with M03 before this cut");
    } else {
      diagnostic.message = fmt::format("no `M03` or `M04` comes before {} {}",
                                       first_.node() == thread_.node() ? "the thread of" : "the cutting move to", move);
      diagnostic.flow = pathFromEntry(facts, *first_.node(), [&](NodeId node) { return starts(node); });
      diagnostic.notes.push_back("start the spindle with S and M03 before the first cut");
      if (const Word *mistyped = mistypedStart(facts))
        diagnostic.labels = {{mistyped->span(), "this code does not start the spindle"}};
    }
    reporter.report(std::move(diagnostic), speaksOfSpindle(facts) || isStartedInFile() || isOfTools(facts) || isLathe_
                                               ? Severity::Warning
                                               : Severity::Info);
  }

private:
  static constexpr std::size_t kStopped = 0; // in kSpindleActions

  /// Chooses the move that is reported; false: none is.
  bool isOfMill(const FlowFacts &facts) {
    if (!first_.node() || standsOnPurpose())
      return false;
    if (preparesTool(facts))
      return true;
    // Grinders, warm-ups and running-in move their axes by G01, and nothing is cut.
    const bool drillsOnly = hole_.node() && isNumbered() && comesToItsEnd(facts);
    if (!intoPart_.node() || !(isWholeAndStarts(facts) || drillsOnly))
      return false;
    first_ = isWholeAndStarts(facts) ? intoPart_ : hole_;
    return true;
  }
  bool isOfLathe(const FlowFacts &facts) {
    if (first_.node() && preparesTool(facts) && !standsOnPurpose() &&
        (isLateOnLathe(facts) || neverStartsOnLathe(facts)))
      return true;
    if (!thread_.node() || isStartedInFile() || !comesToItsEnd(facts) || !isNumbered() ||
        !view_.context().model.callsOf(view_.program()).empty())
      return false;
    first_ = thread_; // which no spindle at rest can cut
    return true;
  }
  /// A tool that takes the bar by its end, or a probe, as a remark says: the spindle has to stand.
  bool standsOnPurpose() const {
    return remarkSays({"PULL", "STOCK TRANSFER", "BAR STOP", "BAR FEED", "STOP BAR"}, TellOf::AllTools) ||
           remarkSays({"PROBE"}, TellOf::ThisTool);
  }
  enum class TellOf : std::uint8_t { AllTools, ThisTool };
  /// Above the first cut, from the head of the program or from the last tool change.
  bool remarkSays(std::initializer_list<std::string_view> words, TellOf of) const {
    const FileContext &context = view_.context();
    bool says = false;
    for (BlockId block = context.model.programs[view_.program()].first; block <= view_.node(*first_.node()).block;
         block = block.next()) {
      const bool isOther = of == TellOf::ThisTool &&
                           findAction(context.tree, block, context.dialect, {CodeAction::ToolChange}) != nullptr;
      says = says && !isOther;
      for (const Comment &comment : context.tree.commentsOf(block)) {
        const std::string text = toUpper(context.text(comment.span));
        says = says ||
               std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
      }
    }
    return says;
  }
  /// Its code, with an end point in the block.
  const Word *threadIn(NodeId node) const {
    if (!view_.mayHave(node, 'X') && !view_.mayHave(node, 'Z') && !view_.mayHave(node, 'W'))
      return nullptr;
    const auto words = view_.wordsOf(node);
    const auto found = std::ranges::find_if(words, [&](const Word *word) {
      const Code *code = codeOf(*word, view_.context().dialect);
      return code && cutsThread(*code);
    });
    return found == words.end() ? nullptr : *found;
  }
  Span placeOf(NodeId move) const {
    const auto words = view_.modalMotionWords(move);
    return words.empty() ? threadIn(move)->span() : words.front()->span();
  }

  bool starts(NodeId node) const {
    return view_.findAction(node, {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise}) != nullptr;
  }
  struct Stop {
    NodeId node;
    std::vector<NodeId> path; // to the move
  };
  /// The nearest M05 in the text with which the spindle still stands at the move.
  std::optional<Stop> stopBefore(const FlowFacts &facts) const {
    for (NodeId stop = *first_.node(); stop != facts.entry();) {
      stop = NodeId(stop.index() - 1);
      if (!facts.isReached(stop) || !view_.findAction(stop, {CodeAction::SpindleStop}))
        continue;
      if (auto path = findPath(facts, stop, *first_.node(), [&](NodeId node) { return starts(node); }))
        return Stop{stop, std::move(*path)};
    }
    return std::nullopt;
  }
  /// A tool, its length or a speed stands before the move.
  bool preparesTool(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next())
      if (std::ranges::any_of(view_.wordsOf(node), [](const Word *word) {
            return word->address() == 'T' || word->address() == 'S' || word->address() == 'H' ||
                   (word->address() == 'M' && word->isCode() && word->integer() == 6);
          }))
        return true;
    return false;
  }
  /// The tool is in the part before the first M03 or M04 of the program.
  bool isWholeAndStarts(const FlowFacts &facts) const {
    bool startsLater = false;
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
      if (starts(node) && node < *intoPart_.node())
        return false; // on another path
      startsLater = startsLater || starts(node);
    }
    return startsLater && comesToItsEnd(facts);
  }
  /// A speed stands before the first cut, and the spindle is started behind it, for another tool.
  bool isLateOnLathe(const FlowFacts &facts) const {
    bool hasSpeed = false;
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next()) {
      const auto words = view_.wordsOf(node);
      hasSpeed = hasSpeed || std::ranges::any_of(words, [](const Word *word) { return word->address() == 'S'; });
      if (starts(node))
        return false; // on another path
    }
    bool startsLater = false;
    for (NodeId node = *first_.node(); node < facts.end(); node = node.next())
      startsLater = startsLater || starts(node);
    return hasSpeed && startsLater;
  }
  /// A whole program with a tool and a speed, and no M03 or M04 in its file.
  bool neverStartsOnLathe(const FlowFacts &facts) const {
    const FileContext &context = view_.context();
    bool hasSpeed = false;
    bool hasTool = false;
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next())
      for (const Word *word : view_.wordsOf(node)) {
        hasTool = hasTool || word->address() == 'T';
        hasSpeed = hasSpeed || (word->address() == 'S' && !view_.findAction(node, {CodeAction::CoordinateSet}));
      }
    return hasSpeed && hasTool && !isStartedInFile() && comesToItsEnd(facts) &&
           context.model.callsOf(view_.program()).empty();
  }
  /// A numbered program that calls the lengths of its tools is for no plotter and no laser.
  bool isOfTools(const FlowFacts &facts) const {
    bool hasLength = false;
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next())
      hasLength = hasLength || view_.mayHave(node, 'H');
    return hasLength && comesToItsEnd(facts) && isNumbered();
  }
  bool isNumbered() const { return !view_.context().model.programs[view_.program()].name.empty(); }
  const Word *mistypedStart(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next())
      for (const Word *word : view_.wordsOf(node))
        if (isMistypedStart(*word, node))
          return word;
    return nullptr;
  }
  /// `S800 M93 (SPINDLE ON)`: one digit is not that of M03 or M04.  M13 and M14 start it together with the coolant.
  bool isMistypedStart(const Word &word, NodeId node) const {
    const auto number = word.address() == 'M' && word.isNumber() ? word.integer() : std::nullopt;
    if (!number || *number < 20 || *number > 99 || (*number % 10 != 3 && *number % 10 != 4) ||
        codeOf(word, view_.context().dialect))
      return false;
    const FileContext &context = view_.context();
    const auto comments = context.tree.commentsOf(view_.node(node).block);
    return findWord(context.tree, view_.node(node).block, 'S') != nullptr &&
           std::ranges::any_of(comments, [&](const Comment &comment) {
             const std::string text = toUpper(context.text(comment.span));
             const auto has = [&](std::string_view part) { return text.find(part) != std::string::npos; };
             return has("SPINDLE") && (has("ON") || has("START")) && !has("SUB") && !has("LIVE") && !has("MILL");
           });
  }
  /// Not an axis of a table, a dresser or a wheelhead alone.
  bool movesTool(NodeId node) const {
    return std::ranges::any_of(view_.modalMotionWords(node), [](const Word *word) {
      return word->address() == 'X' || word->address() == 'Y' || word->address() == 'Z';
    });
  }
  /// Without any word about it the machine may be a plotter or a laser, and the text a piece of a program.
  bool speaksOfSpindle(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
      const auto words = view_.wordsOf(node);
      if (std::ranges::any_of(words, [](const Word *word) { return word->address() == 'S'; }) || starts(node))
        return true;
    }
    return false;
  }
  /// By another program of the memory of the same machine.
  bool isStartedInFile() const {
    for (NodeId node(0); node.index() < view_.cfg().nodes.size(); node = node.next())
      if (starts(node))
        return true;
    return false;
  }
  bool cuts(const AbstractState &state) const {
    return view_.surely(state, ModalKind::Motion,
                        {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
           drills(state);
  }
  bool goesBelowZero(NodeId node, const AbstractState &state) const {
    const auto words = view_.modalMotionWords(node);
    return std::ranges::any_of(words, [](const Word *word) { return word->address() == 'Z'; }) &&
           state.at(Axis::Z).number().interval().hi < 0;
  }
  /// Tapping cycles start the spindle on some controls, and rigid tapping does on all.
  bool drills(const AbstractState &state) const {
    return view_.surely(state, ModalKind::Cycle,
                        {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck,
                         CodeAction::CycleChipBreak, CodeAction::CycleBore, CodeAction::CycleBoreStop,
                         CodeAction::CycleBoreDwell, CodeAction::CycleFineBore});
  }
  /// Down to a level above the zero of the part: an approach at feed.
  bool isAbovePart(NodeId node, const AbstractState &state) const {
    const auto words = view_.modalMotionWords(node);
    return words.size() == 1 && words.front()->address() == 'Z' && state.at(Axis::Z).number().interval().lo > 0;
  }
  /// To where the tool is: a feed that only sets F.
  bool standsStill(NodeId node, const AbstractState &state) const {
    return std::ranges::all_of(view_.modalMotionWords(node), [&](const Word *word) {
      const Axis axis = *axisOf(word->address());
      const auto &from = start_[indexOf(axis)].number().interval(), &to = state.at(axis).number().interval();
      return from.lo == from.hi && to.lo == to.hi && from.lo == to.lo;
    });
  }
  /// M codes of the machine builder often start a spindle, an air turbine, a laser; not one beside a return to the
  /// reference position or a tool change, for which the spindle stands.  A probe cuts nothing.
  bool hasOtherSpindleCode(NodeId node) const {
    if (!view_.mayHave(node, 'M') && !view_.mayHave(node, 'G'))
      return false;
    for (const Word *word : view_.wordsOf(node)) {
      const Code *code = codeOf(*word, view_.context().dialect);
      if (word->address() == 'M' && !code && !isMistypedStart(*word, node) &&
          !view_.findAction(node, {CodeAction::ReferenceReturn, CodeAction::SecondReference, CodeAction::ToolChange}))
        return true;
      if (code && isSkip(code->role))
        return true;
    }
    return false;
  }

  MotionView view_;
  bool asked_;
  bool isLathe_;
  bool mayBeStartedUnseen_ = false;
  FirstSeen first_;
  FirstSeen intoPart_; // below the zero of the part, or a hole
  FirstSeen hole_;
  FirstSeen thread_;                          // of a lathe
  decltype(AbstractState::position) start_{}; // of the instruction
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<SpindleNotStarted>(program, context);
}

} // namespace

extern const Rule spindleNotStarted;
const Rule spindleNotStarted{
    .info = {"spindle-not-started", Category::Motion, Severity::Warning,
             "Reports the first cutting move of a main program when no `M03` or `M04` comes before "
             "it on some path, on a lathe where they come only for a later tool."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::spindle_not_started
