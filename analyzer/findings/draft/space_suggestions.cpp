// See the header.
#include "findings/draft/space_suggestions.h"

#include "findings/draft/argument_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::draft {

namespace {

constexpr double kFarthest = 1e5; // beyond, a bound is none of a workpiece

struct ToolNote {
  std::string shape;
  std::string radius; // `#7`, `#7/2`
  std::string name;   // `TOOL-DIAMETER`
};

bool hasWord(std::string_view name, std::span<const std::string_view> words) {
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('-'), name.size());
    if (std::ranges::find(words, name.substr(0, end)) != words.end())
      return true;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return false;
}

/// Absent: it names no size of a tool; the number of an offset is none.
std::optional<ToolNote> toolIn(std::uint32_t variable, const std::string &name) {
  constexpr std::array<std::string_view, 7> kTools = {"TOOL", "CUTTER", "ENDMILL", "MILL", "DRILL", "REAMER", "BALL"};
  constexpr std::array<std::string_view, 3> kDiameters = {"DIAMETER", "DIA", "DIAM"};
  constexpr std::array<std::string_view, 2> kRadii = {"RADIUS", "RAD"};
  constexpr std::array<std::string_view, 8> kOthers = {"OFFSET", "NUMBER", "NO",     "COMP",
                                                       "WEAR",   "NOSE",   "CORNER", "PROBE"};
  const bool isDiameter = hasWord(name, kDiameters);
  if (!hasWord(name, kTools) || hasWord(name, kOthers) || isDiameter == hasWord(name, kRadii))
    return std::nullopt;
  constexpr std::array<std::string_view, 1> kBall = {"BALL"};
  constexpr std::array<std::string_view, 2> kDrill = {"DRILL", "REAMER"};
  const std::string shape = hasWord(name, kBall) ? "BALL" : hasWord(name, kDrill) ? "DRILL" : "FLAT";
  return ToolNote{shape, fmt::format("#{}{}", variable, isDiameter ? "/2" : ""), name};
}

/// The path is the programmed one, and all of it is in this program.
bool isPlain(const FlowFacts &facts) {
  constexpr std::array kOff = {CodeAction::CompensationOff, CodeAction::CycleOff, CodeAction::ScalingOff,
                               CodeAction::RotationOff,     CodeAction::PolarOff, CodeAction::MirrorOff};
  constexpr std::array kMapping = {ModalKind::Compensation, ModalKind::Cycle, ModalKind::Scaling,
                                   ModalKind::Rotation,     ModalKind::Polar, ModalKind::Mirror};
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (std::holds_alternative<CallProgram>(facts.node(node).instruction))
      return false;
  const Program &program = facts.file.model->programs[facts.program];
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : facts.file.tree->wordsOf(block)) {
      const auto tenths = word.isCode() && word.address() == 'G' ? word.tenths() : std::nullopt;
      const Code *code = tenths ? findGCode(*facts.file.dialect, *tenths) : nullptr;
      if (code && std::ranges::find(kOff, code->action) == kOff.end() &&
          std::ranges::any_of(kMapping, [&](ModalKind kind) { return facts.modes.groupOf(kind) == code->group; }))
        return false;
    }
  return true;
}

/// X, Y, Z; absent: not known.
using Ends = std::array<std::optional<Interval>, 3>;

/// Where the cutting moves of a program begin and end.
class CutWatch : public FlowWatch {
public:
  explicit CutWatch(const FlowFacts &facts) : facts_(facts) {}

  void before(NodeId node, const AbstractState &state) override {
    move_.reset();
    at_ = node;
    start_ = endsOf(state);
  }
  void move(NodeId node, MoveKind kind) override {
    if (node == at_)
      move_ = kind;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (node != at_ || !move_ || *move_ == MoveKind::Rapid || *move_ == MoveKind::Dwell)
      return;
    isStraight_ = isStraight_ && *move_ == MoveKind::Feed;
    add(start_);
    add(endsOf(state));
    lines_.insert(facts_.file.source->lineOf(facts_.file.tree->blocks[facts_.node(node).block].begin));
  }

  bool isStraight() const { return isStraight_; }
  const Ends &extent() const { return extent_; }
  const std::set<std::uint32_t> &lines() const { return lines_; }

private:
  static Ends endsOf(const AbstractState &state) {
    constexpr std::array kAxes = {Axis::X, Axis::Y, Axis::Z};
    Ends found;
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
      const AbstractValue &value = state.at(kAxes[i]);
      const Interval range = value.number().interval();
      if (value.isNumber() && range.isFinite() && range.largest() < kFarthest)
        found[i] = range;
    }
    return found;
  }
  void add(const Ends &more) {
    for (std::size_t i = 0; i < extent_.size(); ++i)
      if (isFirst_)
        extent_[i] = more[i];
      else if (extent_[i])
        extent_[i] = more[i] ? std::optional(join(*extent_[i], *more[i])) : std::nullopt;
    isFirst_ = false;
  }

  const FlowFacts &facts_;
  std::optional<NodeId> at_;
  std::optional<MoveKind> move_;
  Ends start_;
  Ends extent_;
  bool isFirst_ = true;
  bool isStraight_ = true;
  std::set<std::uint32_t> lines_;
};

/// `X[-40-#7/2]..[40+#7/2]`; upwards the tool may be anywhere.
std::string boxOf(const Ends &extent, const std::string &radius) {
  std::string text = "BOX";
  for (std::size_t i = 0; i < 2; ++i)
    text += fmt::format(" {}[{}-{}]..[{}+{}]", "XY"[i], extent[i] -> lo, radius, extent[i] -> hi, radius);
  return text + fmt::format(" Z{}..", extent[2]->lo);
}

/// And never written: a contract speaks of its value on entry.
bool isOnlyRead(const FlowFacts &facts, std::uint32_t variable) {
  const auto uses = facts.file.model->variablesOf(facts.program);
  return std::ranges::any_of(uses, [&](const VariableUse &use) { return use.number == variable; }) &&
         std::ranges::none_of(
             uses, [&](const VariableUse &use) { return use.write && use.number.value_or(variable) == variable; });
}

} // namespace

DraftClauses spaceSuggestions(const Project &project, const FlowFacts &facts, const FileContracts &contracts) {
  if (facts.file.dialect->machine == MachineKind::Turning) // whose comments do not tell the tip of a tool
    return {};
  std::optional<ToolNote> tool;
  for (const auto &[variable, note] : argumentNotes(project, facts.program))
    if (const auto named = toolIn(variable, note.name); named && isOnlyRead(facts, variable)) {
      if (tool)
        return {}; // two tools, or two sizes
      tool = named;
    }
  CutWatch watch(facts);
  FlowWatch *watches[] = {&watch};
  if (!tool || !collectFacts(facts.programs, facts.file.file, facts.program, watches, &contracts).isComplete() ||
      watch.lines().empty())
    return {};
  DraftClauses hints = {{.text = fmt::format("@TOOL {} RADIUS [{}]", tool->shape, tool->radius),
                         .reason = fmt::format("{}; its shape is for you to say", tool->name),
                         .ground = Ground::Hint}};
  const bool isKnown = std::ranges::all_of(watch.extent(), [](const auto &range) { return range.has_value(); });
  if (isKnown && watch.isStraight() && isPlain(facts))
    hints.push_back({.text = fmt::format("@KEEPIN CUT {}", boxOf(watch.extent(), tool->radius)),
                     .reason = fmt::format("where lines {} to {} cut", *watch.lines().begin(), *watch.lines().rbegin()),
                     .ground = Ground::Hint});
  return hints;
}

} // namespace feedhold::draft
