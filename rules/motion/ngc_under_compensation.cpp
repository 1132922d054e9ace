// `G28 Z0`, `G55`, `M66 P1 L0` while G41 is in force, where LinuxCNC stops for that.
#include "rules/motion/ngc_under_compensation.h"

#include "rules/flow/system_variables.h"
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::code_under_compensation {
namespace {

/// G codes in tenths that LinuxCNC refuses; compensation-at-tool-change has M6.
constexpr auto kRefused =
    std::to_array<std::uint16_t>({50,  51,  280, 281, 300, 301, 330, 331, 382, 383, 384, 385, 410, 411, 420, 421, 430,
                                  431, 432, 490, 520, 530, 540, 550, 560, 570, 580, 590, 591, 592, 593, 610, 611, 640,
                                  730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890, 920, 980, 990});
constexpr std::array<std::uint16_t, 13> kRefusedM = {480, 490, 500, 510, 520, 530, 620, 630, 640, 650, 660, 670, 680};

class NgcUnderCompensation final : public FlowRule {
public:
  NgcUnderCompensation(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    const auto actions = {CodeAction::CompensationLeft, CodeAction::CompensationRight};
    const bool isOn = !isHavocked(state) && view_.wasSet(state, ModalKind::Compensation, actions) &&
                      view_.surely(state, ModalKind::Compensation, actions);
    if (const auto [at, isNew] = compensated_.emplace(node, isOn); !isNew)
      at->second = at->second && isOn;
    const Word *refused = isOn ? refusedIn(node, state) : nullptr;
    const auto [at, isNew] = places_.emplace(node, refused);
    if (!isNew && !refused)
      at->second = nullptr;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, code] : places_) {
      if (!code)
        continue;
      Diagnostic diagnostic{
          .message = fmt::format("the control does not take {} while cutter compensation is active",
                                 context.quoted(code->span())),
          .span = code->span(),
          .flow = pathFromEntry(facts, node),
          .notes = {"the control stops with an error", "cancel the compensation first, with `G40` in a straight move"}};
      if (const Word *start = startBefore(node); start && start != code)
        diagnostic.labels = {{start->span(), "started here"}};
      reporter.report(std::move(diagnostic));
      break; // what follows is of the same cause
    }
    reportReads(facts, context, reporter);
  }

private:
  /// `#5420`: where the tool is.
  void reportReads(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) const {
    for (const VariableUse &use : context.model.variablesOf(view_.program())) {
      if (use.write || !use.number || roleOf(context, *use.number) != VariableRole::WorkPosition)
        continue;
      const auto node = nodeOf(facts, use.block, use.expression);
      const auto known = node ? compensated_.find(*node) : compensated_.end();
      if (known == compensated_.end() || !known->second)
        continue;
      const Span span = context.tree.expressions[use.expression].span;
      reporter.report({.message = fmt::format("{} is read while cutter compensation is active", context.quoted(span)),
                       .span = span,
                       .flow = pathFromEntry(facts, *node),
                       .notes = {"the control stops with an error: it does not tell the position then",
                                 "read it before G41 or G42, or behind G40"}});
      return;
    }
  }
  const Word *refusedIn(NodeId node, const AbstractState &state) const {
    const auto block = NgcBlock::of(view_, node);
    if (!block)
      return nullptr;
    if (const Word *code = block->code('M', kRefusedM))
      return code;
    if (block->code('G', {400})) // comes before the other G codes of its block
      return nullptr;
    if (const Word *code = block->code('G', kRefused))
      return code;
    if (const Word *plane = changedPlane(*block, state))
      return plane;
    return ownOffset(*block, state);
  }
  /// `G18` while G17 is active: the same plane once more is no change.
  const Word *changedPlane(const NgcBlock &block, const AbstractState &state) const {
    struct Plane {
      std::uint16_t tenths;
      CodeAction action;
    };
    constexpr std::array kPlanes = {Plane{170, CodeAction::PlaneXY}, Plane{180, CodeAction::PlaneZX},
                                    Plane{190, CodeAction::PlaneYZ}};
    for (const Plane &plane : kPlanes)
      if (const Word *code = block.code('G', {plane.tenths}))
        return isOtherPlane(plane.action, state) ? code : nullptr;
    return nullptr;
  }
  bool isOtherPlane(CodeAction plane, const AbstractState &state) const {
    return !view_.mayBe(state, ModalKind::Plane, {plane});
  }
  /// `G10 L2 P0`, or its number: the coordinate system that is active.
  const Word *ownOffset(const NgcBlock &block, const AbstractState &state) const {
    const Word *data = block.code('G', {100});
    const Word *table = data ? block.find('L') : nullptr;
    const Word *number = table ? block.find('P') : nullptr;
    const bool isSystem = number && (table->integer() == 2 || table->integer() == 20);
    const auto which = isSystem ? number->integer() : std::nullopt;
    return which && (*which == 0 || which == systemInForce(state)) ? data : nullptr;
  }
  /// G54 is 1, G59.3 is 9.
  std::optional<std::uint32_t> systemInForce(const AbstractState &state) const {
    constexpr std::uint32_t kFirst = 540, kSixth = 590;
    const auto group = view_.modes().groupOf(ModalKind::WorkOffset);
    const auto codes = view_.inForce(state, ModalKind::WorkOffset);
    const auto only = codes ? codes->only() : std::nullopt;
    if (!only)
      return std::nullopt;
    const std::uint32_t tenths = view_.modes().group(*group).codes[*only]->tenths;
    return tenths <= kSixth ? (tenths - kFirst) / 10 + 1 : tenths - kSixth + 6;
  }
  /// The last one in the text before the code.
  const Word *startBefore(NodeId code) const {
    for (NodeId node = code; node.index() > 0;) {
      node = NodeId(node.index() - 1);
      if (const Word *start = view_.findAction(node, {CodeAction::CompensationLeft, CodeAction::CompensationRight}))
        return start;
    }
    return nullptr;
  }

  MotionView view_;
  std::map<NodeId, const Word *> places_; // on all paths
  std::map<NodeId, bool> compensated_;    // likewise
};

} // namespace

std::unique_ptr<FlowRule> watchNgc(ProgramId program, const FileContext &context) {
  return std::make_unique<NgcUnderCompensation>(program, context);
}

} // namespace feedhold::rules::code_under_compensation
