// code-under-compensation: `G41 D1 ..`, and `G31` or another plane before any `G40`.
#include "rules/motion/motion_view.h"
#include "rules/motion/ngc_under_compensation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace feedhold::rules::code_under_compensation {
namespace {

/// A code that stops the control, with what FANUC controls call it.  Source: the alarm lists of their manuals.
struct Forbidden {
  const Word *code = nullptr;
  std::string_view alarm;
};

constexpr std::array kPlanes = {CodeAction::PlaneXY, CodeAction::PlaneZX, CodeAction::PlaneYZ};
constexpr std::uint16_t kFirstToolOffset = 450; // G45 to G48
constexpr std::uint16_t kLastToolOffset = 480;

bool isPolarInterpolation(const Code &code) { return code.tenths == 121 || code.tenths == 1120; }

class CodeUnderCompensation final : public FlowRule {
public:
  CodeUnderCompensation(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'G') || view_.findAction(node, {CodeAction::CompensationOff}))
      return;
    const bool isActive =
        !isHavocked(state) &&
        view_.surely(state, ModalKind::Compensation, {CodeAction::CompensationLeft, CodeAction::CompensationRight});
    const Forbidden found = isActive ? forbiddenIn(node, state) : Forbidden{};
    const auto [at, isNew] = places_.emplace(node, found);
    if (!isNew && !found.code)
      at->second = {};
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    const bool isFanuc = context.dialect.hasFanucParameters;
    for (const auto &[node, found] : places_)
      if (found.code)
        reporter.report(
            {.message = fmt::format("{} while the tool radius is compensated", context.quoted(found.code->span())),
             .span = found.code->span(),
             .flow = pathFromEntry(facts, node),
             .notes = {isFanuc ? fmt::format("the control stops with {}", found.alarm)
                               : std::string("the control stops with an alarm"),
                       "end the compensation by `G40` and a move before this block"}});
  }

private:
  Forbidden forbiddenIn(NodeId node, const AbstractState &state) const {
    const Dialect &dialect = view_.context().dialect;
    const bool isMilling = dialect.machine == MachineKind::Milling;
    for (const Word *word : view_.wordsOf(node)) {
      const Code *code = word->address() == 'G' ? codeOf(*word, dialect) : nullptr;
      if (!code)
        continue;
      if (code->role == CodeRole::Skip)
        return {word, isMilling ? "PS0036 (G31 during compensation)" : "PS0035 (G31 during compensation)"};
      if (std::ranges::find(kPlanes, code->action) != kPlanes.end() && isOtherPlane(code->action, state))
        return {word, "PS0037 (plane changed during compensation)"};
      if (!dialect.hasFanucParameters)
        continue;
      if (isPolarInterpolation(*code))
        return {word, "PS0146 (polar coordinate interpolation begins during compensation)"};
      if (isMilling && code->tenths >= kFirstToolOffset && code->tenths <= kLastToolOffset &&
          code->action == CodeAction::OtherCycle)
        return {word, "PS0042 (G45 to G48 during compensation)"};
    }
    return {};
  }
  bool isOtherPlane(CodeAction plane, const AbstractState &state) const {
    return std::ranges::any_of(
        kPlanes, [&](CodeAction other) { return other != plane && view_.surely(state, ModalKind::Plane, {other}); });
  }

  MotionView view_;
  std::map<NodeId, Forbidden> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  if (context.dialect.behaviour.stopsAtStrayWords)
    return watchNgc(program, context);
  return std::make_unique<CodeUnderCompensation>(program, context);
}

} // namespace

extern const Rule codeUnderCompensation;
const Rule codeUnderCompensation{
    .info = {"code-under-compensation", Category::Motion, Severity::Error,
             "Reports a skip move, a change of plane or another code that the control refuses during `G41` or `G42`."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::code_under_compensation
