// rpm-at-constant-surface-speed: `G96`, `M03 S1000 (1000 RPM)`; `G96 S180`, `G96 S6000`, where `G50 S6000` was meant.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace feedhold::rules::rpm_at_constant_surface_speed {
namespace {

constexpr std::array<std::string_view, 3> kRevolutions = {"RPM", "U/MIN", "1/MIN"};
constexpr std::array<std::string_view, 8> kSurface = {"SFM", "SFPM", "SMM", "M/MIN", "MPM", "FPM", "CSS", "SURFACE"};

bool mentions(std::string_view text, std::span<const std::string_view> units) {
  return std::ranges::any_of(units, [&](std::string_view unit) { return text.find(unit) != std::string_view::npos; });
}

/// `(1000 RPM)`, `(RPM = 4*250/1 = 1000)`: the number of the word is given in revolutions.
bool givesRevolutions(std::string_view comment, const std::string &number) {
  const std::string text = toUpper(trimmed(comment.substr(1, comment.size() - 2)));
  if (mentions(text, kSurface))
    return false;
  for (std::size_t at = text.find(number); at != std::string::npos; at = text.find(number, at + 1)) {
    const std::size_t end = at + number.size();
    const bool isWhole = (at == 0 || (!isDigit(text[at - 1]) && text[at - 1] != '.')) &&
                         (end == text.size() || (!isDigit(text[end]) && text[end] != '.'));
    const std::string_view behind = trimmed(std::string_view(text).substr(end));
    const auto follows = [&](std::string_view unit) { return behind.starts_with(unit); };
    const bool isResult = behind.empty() && text.starts_with("RPM");
    if (isWhole && (isResult || std::ranges::any_of(kRevolutions, follows)))
      return true;
  }
  return false;
}

/// The S of a block whose comment, or a line of comment above it, gives it in revolutions; not one that limits the
/// speed.
const Word *revolutionsIn(BlockId block, const FileContext &context) {
  const Word *speed = findWord(context.tree, block, 'S');
  const auto number = speed && speed->isNumber() ? speed->integer() : std::nullopt;
  if (!number || std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
        return word.address() == 'G' && (word.integer() == 50 || word.integer() == 92);
      }))
    return nullptr;
  const auto gives = [&](BlockId each) {
    return std::ranges::any_of(context.tree.commentsOf(each), [&](const Comment &comment) {
      return comment.span.size() > 2 && givesRevolutions(context.text(comment.span), std::to_string(*number));
    });
  };
  const BlockId above(block.index() == 0 ? 0 : block.index() - 1);
  // A comment beside another S, such as the limit of the spindle, is not about that one if the numbers differ.
  const Word *other = findWord(context.tree, above, 'S');
  const bool isAboutThis = isEmpty(context.tree, above) || (other && other->isNumber() && other->integer() != number);
  return gives(block) || (isAboutThis && gives(above)) ? speed : nullptr;
}

void tell(const Word &speed, const Word &mode, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("the comment gives {} in revolutions, but under {} it is a surface speed",
                                          context.quoted(speed.span()), context.quoted(mode.span())),
                   .span = speed.span(),
                   .labels = {{mode.span(), "constant surface speed from here"}},
                   .notes = {"the spindle turns at another speed, and faster towards the centre, up to its limit",
                             "program `G97` for revolutions per minute, or the surface speed as S"}});
}

/// Surface speeds that no lathe cuts with, in m/min, and in ft/min; a text that does not name its units may be in
/// either.
constexpr double kFastest = 2500;
constexpr double kFastestInFeet = 8000;
/// Directly behind another surface speed, a number that looks like a limit of the spindle.
constexpr double kLeastLimit = 1000;
constexpr double kLeastFactor = 5;

bool isMetric(const Program &program, const FileContext &context) {
  bool isMetric = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::Inch}))
      return false;
    isMetric = isMetric || findAction(context.tree, block, context.dialect, {CodeAction::Metric});
  }
  return isMetric;
}

/// The S of a `G96 S..`, as a number.
const Word *surfaceSpeedIn(BlockId block, const FileContext &context) {
  const Word *code = findAction(context.tree, block, context.dialect, {CodeAction::ConstantSurface});
  const Word *speed = code ? findWord(context.tree, block, 'S') : nullptr;
  return speed && speed->isNumber() ? speed : nullptr;
}

void tellSize(const Word &speed, const Word *before, const FileContext &context, const Reporter &reporter) {
  Diagnostic diagnostic{.message = fmt::format("{} is no surface speed by its size", context.quoted(speed.span())),
                        .span = speed.span(),
                        .notes = {"the spindle runs at its highest speed, or at its limit, on all diameters",
                                  "program `G97` for revolutions per minute, or `G50` for the limit of the spindle"}};
  if (before)
    diagnostic.labels = {{before->span(), "the surface speed that it replaces"}};
  reporter.report(std::move(diagnostic));
}

/// Once in a program.
void checkSizes(const Program &its, const FileContext &context, const Reporter &reporter) {
  const double fastest = isMetric(its, context) ? kFastest : kFastestInFeet;
  const Word *before = nullptr; // in the block above
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (isEmpty(context.tree, block))
      continue;
    const Word *speed = surfaceSpeedIn(block, context);
    const double size = speed ? speed->number().toDouble() : 0;
    const bool replaces = before && size >= kLeastLimit && size >= kLeastFactor * before->number().toDouble();
    if (size > fastest || replaces)
      return tellSize(*speed, replaces ? before : nullptr, context, reporter);
    before = speed;
  }
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Word *constant = nullptr; // the G96 in force
  const Word *speed = nullptr;    // an S in revolutions that a G96 behind it may take
  const Program &its = context.model.programs[program];
  if (context.dialect.machine == MachineKind::Turning)
    checkSizes(its, context, reporter);
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const bool isUnclear = !context.model.callsIn(block, block.next()).empty() ||
                           !context.model.jumpsIn(block, block.next()).empty() ||
                           context.tree.blocks[block].has(Block::kSkip);
    if (isUnclear)
      constant = speed = nullptr;
    const Word *begins = findAction(context.tree, block, context.dialect, {CodeAction::ConstantSurface});
    if (begins)
      constant = begins;
    else if (findAction(context.tree, block, context.dialect, {CodeAction::ConstantSpeed}))
      constant = speed = nullptr;
    const bool hasSpeed = findWord(context.tree, block, 'S') != nullptr;
    if (const Word *own = revolutionsIn(block, context)) {
      if (constant)
        tell(*own, *constant, context, reporter);
      speed = constant ? nullptr : own;
    } else if (begins && !hasSpeed && speed) {
      tell(*speed, *begins, context, reporter);
      speed = nullptr;
    } else if (hasSpeed || findAction(context.tree, block, context.dialect, {CodeAction::ToolChange})) {
      speed = nullptr;
    }
  }
}

} // namespace

extern const Rule rpmAtConstantSurfaceSpeed;
const Rule rpmAtConstantSurfaceSpeed{.info = {"rpm-at-constant-surface-speed", Category::Motion, Severity::Warning,
                                              "Reports an `S` under `G96` that is given in revolutions per minute, as "
                                              "its comment says, or as its size shows."},
                                     .hooks = {.program = check}};

} // namespace feedhold::rules::rpm_at_constant_surface_speed
