// remark-of-other-time: `G04 P300 (WAIT 5 MINUTES)`: P counts milliseconds.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

namespace feedhold::rules::remark_of_other_time {
namespace {

constexpr double kMillisecond = 0.001;

/// The unit behind a number of a remark, in seconds.
std::optional<double> unitAt(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() && isLetter(text[length]))
    ++length;
  const std::string_view word = text.substr(0, length);
  for (const std::string_view minutes : {"MIN", "MINS", "MINUTE", "MINUTES", "MINUTOS"})
    if (word == minutes)
      return 60;
  for (const std::string_view seconds : {"S", "SEC", "SECS", "SECOND", "SECONDS", "SEG", "SEGUNDOS", "SEK"})
    if (word == seconds)
      return 1;
  for (const std::string_view milliseconds : {"MS", "MSEC"})
    if (word == milliseconds)
      return kMillisecond;
  return std::nullopt;
}

/// `WAIT 5 MINUTES`, `0.5SEC`: the only time that the remark names, in seconds.
std::optional<double> timeIn(std::string_view remark) {
  std::optional<double> found;
  for (std::size_t at = 1; at < remark.size(); ++at) {
    if (!isDigit(remark[at]) || isDigit(remark[at - 1]) || remark[at - 1] == '.' || isLetter(remark[at - 1]))
      continue;
    std::string digits;
    while (at < remark.size() && (isDigit(remark[at]) || remark[at] == '.'))
      digits += remark[at++];
    const std::size_t unit = std::min(remark.find_first_not_of(' ', at), remark.size());
    if (const auto seconds = unitAt(remark.substr(unit))) {
      if (found)
        return std::nullopt;
      found = std::strtod(digits.c_str(), nullptr) * *seconds;
    }
  }
  return found;
}

/// `(THIS MACHINE TAKES DWELL VALUES IN SECONDS)`
bool tellsUnit(const FileContext &context) {
  return std::ranges::any_of(context.tree.comments, [&](const Comment &comment) {
    const std::string text = toUpper(context.text(comment.span));
    return text.find("DWELL") != std::string::npos && text.find("IN SECONDS") != std::string::npos;
  });
}

/// LinuxCNC and grbl, whose programs have no O number, count P in seconds.
bool isInMilliseconds(const Word &word, BlockId block, const FileContext &context) {
  return word.isNumber() && !word.has(Word::kPoint) && !context.dialect.grammar.oWords &&
         context.model.programs[context.model.programOf(block)].name.number;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr double kMostApart = 3;
  if (context.tree.commentsOf(block).empty() || !findCode(context.tree, block, context.dialect, CodeRole::Dwell))
    return;
  const Word *time = findWord(context.tree, block, 'P');
  const auto said = time && isInMilliseconds(*time, block, context) ? timeIn(remarksOf(context, block)) : std::nullopt;
  if (!said || *said <= 0 || time->number().isZero())
    return;
  const double waits = time->number().toDouble() * kMillisecond;
  if ((waits < *said * kMostApart && *said < waits * kMostApart) || tellsUnit(context))
    return;
  reporter.report(
      {.message = fmt::format("{} waits {:.4g} seconds, not {:.4g} as the remark says", context.quoted(time->span()),
                              waits, *said),
       .span = time->span(),
       .labels = {{context.tree.commentsOf(block).front().span, "the remark"}},
       .notes = {fmt::format("P counts milliseconds: write `P{:.0f}`, or correct the remark", *said / kMillisecond)}});
}

} // namespace

extern const Rule remarkOfOtherTime;
const Rule remarkOfOtherTime{.info = {"remark-of-other-time", Category::Comment, Severity::Warning,
                                      "Reports a dwell of another time than the remark beside it names."},
                             .hooks = {.block = check}};

} // namespace feedhold::rules::remark_of_other_time
