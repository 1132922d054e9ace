// code-number-range: `G30 P5`, `G08 P2`, `G51 P0`.
#include "rules/words/word_values.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

namespace feedhold::rules::code_number_range {
namespace {

/// A word of a code that takes a few whole numbers only.  Source: the alarm lists of the FANUC manuals.
struct Row {
  std::uint16_t tenths;
  CodeAction action;
  char address;
  AllowedNumbers allowed;
  bool isWhole;
  bool mayBeMissing;
  std::string_view numbers;
  std::string_view alarm;
  double other = 0; // numbers from here on have meanings of their own
};
constexpr std::array kRows = {
    Row{80, CodeAction::Tolerance, 'P', {0, 1}, true, false, "P1 begins the mode, P0 ends it", "PS0109"},
    Row{300, CodeAction::SecondReference, 'P', {2, 4}, true, true, "P2, P3 or P4, or none for P2", "PS0046"},
    Row{310, CodeAction::Skip, 'P', {1, 4}, true, true, "P1 to P4 name a skip signal", "PS0370", 90},
    Row{510, CodeAction::ScalingOn, 'P', {1e-9}, false, true, "the factor is not 0", "PS0142"},
};

struct Use {
  const Row *row;
  const Word *code;
};

std::optional<Use> useIn(BlockId block, const FileContext &context) {
  if (!context.dialect.hasFanucParameters || context.tree.blocks[block].has(Block::kBroken) ||
      context.tree.blocks[block].has(Block::kData))
    return std::nullopt;
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
    for (const Row &row : kRows)
      if (code && code->tenths == row.tenths && code->action == row.action &&
          context.model.callsIn(block, block.next()).empty())
        return Use{&row, &word};
  }
  return std::nullopt;
}

std::string stops(const Row &row) { return fmt::format("the control stops with {}: {}", row.alarm, row.numbers); }

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto use = useIn(block, context);
  if (!use)
    return;
  const Word *word = findWord(context.tree, block, use->row->address);
  if (!word) {
    if (!use->row->mayBeMissing)
      reporter.report({.message = fmt::format("{} has no `{}`", context.quoted(use->code->span()), use->row->address),
                       .span = use->code->span(),
                       .notes = {stops(*use->row)}});
    return;
  }
  const double number = word->isNumber() ? std::abs(word->number().toDouble()) : 0;
  if (!word->isNumber() || use->row->allowed.contains(number) || (use->row->other > 0 && number >= use->row->other))
    return;
  reporter.report(
      {.message = fmt::format("{} has no {}", context.quoted(use->code->span()), context.quoted(word->span())),
       .span = word->span(),
       .labels = {{use->code->span(), "the code"}},
       .notes = {stops(*use->row)}});
}

void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.hasFanucParameters)
    return;
  for (const ComputedWord &computed : computedWordsOf(facts)) {
    const auto use = computed.word->address() == 'P' ? useIn(computed.block, context) : std::nullopt;
    if (!use)
      continue;
    AllowedNumbers allowed = use->row->allowed;
    if (use->row->isWhole)
      allowed = {allowed.least - 0.5, std::nextafter(allowed.most + 0.5, 0)};
    const Outside outside = use->row->other > 0 ? Outside::Never : outsideOf(*computed.value, allowed);
    if (outside == Outside::Never)
      continue;
    Diagnostic diagnostic{.message = fmt::format("{} {}, which {} does not have", context.quoted(computed.word->span()),
                                                 describeNumber(*computed.value, allowed, outside),
                                                 context.quoted(use->code->span())),
                          .span = computed.word->span(),
                          .labels = {{use->code->span(), "the code"}},
                          .flow = pathOf(facts, computed, outside),
                          .notes = {stops(*use->row)}};
    reporter.report(std::move(diagnostic), outside == Outside::Always ? Severity::Error : Severity::Warning);
  }
}

} // namespace

extern const Rule codeNumberRange;
const Rule codeNumberRange{.info = {"code-number-range", Category::Word, Severity::Error,
                                    "Reports a number beside a G code that takes only a few, such as `G30 P5`."},
                           .hooks = {.block = check, .flow = checkComputed}};

} // namespace feedhold::rules::code_number_range
