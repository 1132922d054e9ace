// code-in-polar-interpolation: `G12.1`, and `G28` or `G54` before `G13.1`.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace feedhold::rules::code_in_polar_interpolation {
namespace {

enum class Mode : std::uint8_t { None, Polar, Cylindrical };

struct Region {
  Mode mode = Mode::None;
  const Word *code = nullptr; // began it
};

const Word *gCode(BlockId block, std::initializer_list<std::uint16_t> tenths, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(block))
    if (const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr)
      if (std::ranges::find(tenths, code->tenths) != tenths.end())
        return &word;
  return nullptr;
}

/// `G07.1 C0`
bool endsCylinder(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return std::string_view("XYZUVWABCH").find(word.address()) != std::string_view::npos && word.isNumber() &&
           word.number().isZero();
  });
}

/// The mode behind the block; the same as before where nothing begins or ends one.
Region behind(const Region &before, BlockId block, const FileContext &context) {
  if (gCode(block, {131, 1130}, context))
    return {};
  if (const Word *code = gCode(block, {121, 1120}, context))
    return {Mode::Polar, code};
  if (const Word *code = gCode(block, {71, 1070}, context))
    return endsCylinder(block, context) ? Region{} : Region{Mode::Cylindrical, code};
  return before;
}

constexpr std::uint16_t kPolarAsHaas = 1120; // G112

/// Source: the texts of PS0146 and PS0176, and what the programming manuals say of coordinate systems under G07.1.
bool isRefused(const Code &code, const Region &region) {
  constexpr std::array kRoles = {CodeRole::ReferenceReturn, CodeRole::MachinePosition};
  constexpr std::array kActions = {CodeAction::LocalShift, CodeAction::SideCycle};
  constexpr std::array kOfPolar = {CodeAction::PlaneXY, CodeAction::PlaneZX,    CodeAction::PlaneYZ,
                                   CodeAction::Thread,  CodeAction::RotationOn, CodeAction::Skip};
  constexpr std::array kOfCylinder = {CodeAction::WorkOffset, CodeAction::ExtendedWorkOffset};
  const auto has = [](const auto &all, auto each) { return std::ranges::find(all, each) != all.end(); };
  const bool isDrilling = CodeAction::CycleDrill <= code.action && code.action <= CodeAction::CycleFineBore;
  // Haas lathes take G00 behind G112, and their programs may be taken for those of a FANUC.
  if (code.action == CodeAction::Rapid)
    return region.code->tenths() != kPolarAsHaas;
  return has(kRoles, code.role) || has(kActions, code.action) || isDrilling || isSingleTurningCycle(code.action) ||
         (region.mode == Mode::Polar ? has(kOfPolar, code.action) : has(kOfCylinder, code.action));
}

void report(const Word &word, const Region &region, const FileContext &context, const Reporter &reporter) {
  const bool isPolar = region.mode == Mode::Polar;
  reporter.report({.message = fmt::format("{} while {} is active", context.quoted(word.span()),
                                          isPolar ? "polar coordinate interpolation" : "cylindrical interpolation"),
                   .span = word.span(),
                   .labels = {{region.code->span(), "begins here"}},
                   .notes = {isPolar ? "the control stops with PS0146 (G code not allowed in this mode)"
                                     : "the control stops with PS0176 (G code not allowed in this mode)",
                             isPolar ? "end the mode by `G13.1` before this block"
                                     : "end the mode by `G07.1` with the radius 0 before this block"}});
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.hasFanucParameters)
    return;
  const Program &program = context.model.programs[id];
  const HiddenWork hidden(id, context);
  Region region;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const bool isLeft = findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd) ||
                        findCode(context.tree, block, context.dialect, CodeRole::Return);
    if (hidden.isIn(block) || isLeft || context.tree.blocks[block].has(Block::kBroken)) {
      region = {}; // other blocks may lead here, or on from here
      continue;
    }
    if (const Region next = behind(region, block, context); next.code != region.code) {
      region = next;
      continue;
    }
    if (region.mode == Mode::None || meansOwnWords(context.tree, block, context.dialect))
      continue;
    for (const Word &word : context.tree.wordsOf(block))
      if (const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
          code && isRefused(*code, region)) {
        report(word, region, context, reporter);
        break;
      }
  }
}

} // namespace

extern const Rule codeInPolarInterpolation;
const Rule codeInPolarInterpolation{.info = {"code-in-polar-interpolation", Category::Motion, Severity::Error,
                                             "Reports a rapid move, a reference return, a canned cycle or another code "
                                             "that the control refuses between `G12.1` "
                                             "and `G13.1`, or while `G07.1` is active."},
                                    .hooks = {.program = check}};

} // namespace feedhold::rules::code_in_polar_interpolation
