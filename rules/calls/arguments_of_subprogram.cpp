// arguments-of-subprogram: `M98 P9001 I10. D2.`
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace feedhold::rules::arguments_of_subprogram {
namespace {

/// Letters that mean nothing in a block that only calls; the axes move, and F, S, T are taken over.
constexpr std::string_view kMeaningless = "DEIJKR";
/// M98 has them itself on some control.
constexpr std::string_view kOfCall = "PLQHNOGM";

/// A code beside the M98 that takes I, J, K, R for itself.
bool hasOwnCode(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const Code *code = codeOf(word, context.dialect);
    return word.isCode() && (!code || code->role == CodeRole::Arc || code->role == CodeRole::CannedCycle ||
                             code->role == CodeRole::Contour || code->role == CodeRole::DataSetting ||
                             code->role == CodeRole::CoordinateShift || code->action == CodeAction::RotationOn ||
                             code->action == CodeAction::CompensationLeft ||
                             code->action == CodeAction::CompensationRight || code->action == CodeAction::ScalingOn);
  });
}

bool sets(std::span<const VariableUse> uses, std::uint32_t variable) {
  return std::ranges::any_of(uses, [&](const VariableUse &use) { return use.write && use.number == variable; });
}

/// The called program takes the variable as an argument: it reads it, and neither program sets it.
bool takes(const FileContext &context, const Call &call, ProgramRef callee, std::uint32_t variable) {
  const ProgramModel &model = context.callGraph.model(callee.file);
  const auto uses = model.variablesOf(callee.program);
  return !sets(uses, variable) && !sets(context.model.variablesOf(call.caller), variable) &&
         std::ranges::any_of(uses, [&](const VariableUse &use) { return use.number == variable; });
}

struct Words {
  std::vector<const Word *> meaningless;
  const Word *taken = nullptr; // whose variable the called program reads
};

Words wordsBeside(const FileContext &context, const Call &call) {
  Words found;
  const auto callee = context.callGraph.callee(context.file, call);
  for (const Word &word : context.tree.wordsOf(call.block)) {
    const char letter = word.address();
    if (word.has(Word::kComma) || kOfCall.find(letter) != std::string_view::npos)
      continue;
    if (kMeaningless.find(letter) != std::string_view::npos)
      found.meaningless.push_back(&word);
    const std::uint8_t variable = argumentVariable(context.dialect, letter);
    if (!found.taken && callee && variable != 0 && takes(context, call, *callee, variable))
      found.taken = &word;
  }
  return found;
}

/// D and R may belong to a mode, E to a builder's code, and I, J, K to an arc that is in force.
bool isClear(const FileContext &context, const Call &call, const std::vector<const Word *> &meaningless) {
  const auto isAny = [](std::string_view letters) {
    return [letters](const Word &word) { return letters.find(word.address()) != std::string_view::npos; };
  };
  const auto words = context.tree.wordsOf(call.block);
  return meaningless.size() >= 2 ||
         (std::ranges::any_of(words, isAny("IJK")) && std::ranges::none_of(words, isAny("XYZ")));
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  if (call.kind != CallKind::Subprogram || !call.programWord || hasOwnCode(context, call.block))
    return;
  const Words words = wordsBeside(context, call);
  if (!words.taken && !isClear(context, call, words.meaningless))
    return;
  const Word &word = words.taken ? *words.taken : *words.meaningless.front();
  reporter.report(
      {.message = fmt::format("`M98` passes no arguments: {} does not reach {}", context.quoted(word.span()),
                              call.callee.empty() ? "the called program" : toString(call.callee)),
       .span = word.span(),
       .labels = {{call.span, "called here"}},
       .notes = {"X, Y and Z of this block move the tool, and the local variables of the called program "
                 "stay as they are",
                 "call a macro that takes arguments with `G65`"}});
}

} // namespace

extern const Rule argumentsOfSubprogram;
const Rule argumentsOfSubprogram{.info = {"arguments-of-subprogram", Category::Call, Severity::Warning,
                                          "Reports words beside `M98` that are meant as arguments."},
                                 .hooks = {.call = check}};

} // namespace feedhold::rules::arguments_of_subprogram
