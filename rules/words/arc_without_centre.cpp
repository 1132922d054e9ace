// arc-without-centre: `G02 X10. Y0.`.
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::arc_without_centre {
namespace {

bool isEndPoint(const Word &word, const FileContext &context) {
  return formatOf(context.dialect, word.address()).kind == AddressKind::Length && !word.has(Word::kComma);
}

bool isCentre(const Word &word) {
  return std::string_view("IJKR").find(word.address()) != std::string_view::npos && !word.has(Word::kComma);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto words = context.tree.wordsOf(block);
  const Word *arc = words.size() < 2 ? nullptr : findCode(context.tree, block, context.dialect, CodeRole::Arc);
  if (!arc || std::any_of(words.begin(), words.end(), isCentre) || meansOwnWords(context, block))
    return;
  if (std::none_of(words.begin(), words.end(), [&](const Word &word) { return isEndPoint(word, context); }))
    return;
  reporter.report({.message = fmt::format("{} has neither `R` nor `I J K`", context.quoted(arc->span())),
                   .span = arc->span(),
                   .notes = {fmt::format("the control {}{}", stopsWith(context.dialect, AlarmKind::ArcWithoutCentre),
                                         context.dialect.hasFanucParameters
                                             ? ", or moves in a straight line if parameter 3403#5 (CIR) is 0"
                                             : ""),
                             "add R or I, J, K; for a straight move write G01"}});
}

} // namespace

extern const Rule arcWithoutCentre;
const Rule arcWithoutCentre{.info = {"arc-without-centre", Category::Word, Severity::Error,
                                     "Reports an arc with an end point but without `R` and without `I J K`."},
                            .hooks = {.block = check}};

} // namespace feedhold::rules::arc_without_centre
