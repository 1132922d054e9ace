// argument-without-point: `G65 P9010 X10` may pass 0.010.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::argument_without_point {
namespace {

bool isScaled(const Argument &argument, const FileContext &context) {
  const Word &word = wordOf(context, argument.word);
  const AddressKind kind = formatOf(context.dialect, word.address()).kind;
  return word.isNumber() && argument.variable != 0 && (kind == AddressKind::Length || kind == AddressKind::Angle);
}

bool lacksPoint(const Argument &argument, const FileContext &context) {
  const Word &word = wordOf(context, argument.word);
  return isScaled(argument, context) && !word.has(Word::kPoint) && !word.number().isZero();
}

/// Who writes some lengths of a call with a point and others without works by increments, or forgot one.
bool mixesForms(const Call &call, const FileContext &context) {
  return std::ranges::any_of(call.arguments, [&](const Argument &argument) {
    return isScaled(argument, context) && wordOf(context, argument.word).has(Word::kPoint);
  });
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const Switch dpi = context.dialect.switches.dpi;
  if (!isMacroCall(call.kind) || dpi == Switch::On || (dpi == Switch::Unknown && !mixesForms(call, context)))
    return;
  const auto first =
      std::ranges::find_if(call.arguments, [&](const Argument &argument) { return lacksPoint(argument, context); });
  if (first == call.arguments.end())
    return;
  const std::string_view setting = context.dialect.hasFanucParameters
                                       ? "parameter 3401#0 (DPI)"
                                       : "a setting of the machine (`dpi` in feedhold.toml)";
  const LeastIncrements increments = leastIncrementsOf(context.dialect);
  const std::string example =
      fmt::format("such as {} mm or {} inch", increments.metric.toString(), increments.inch.toString());
  Diagnostic diagnostic{
      .message = fmt::format("argument {} has no decimal point", context.quoted(wordOf(context, first->word).span())),
      .span = wordOf(context, first->word).span(),
      .notes = {dpi == Switch::Off ? fmt::format("the control reads it in least increments, {}", example)
                                   : fmt::format("{} decides: whole units, or least increments {}", setting, example),
                "with a decimal point the value is the same on every machine"}};
  for (auto other = std::next(first); other != call.arguments.end(); ++other)
    if (lacksPoint(*other, context))
      diagnostic.labels.push_back({wordOf(context, other->word).span(), "this one too"});
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule argumentWithoutPoint;
const Rule argumentWithoutPoint{.info = {"argument-without-point", Category::Call, Severity::Info,
                                         "Reports a length or angle that a macro call passes without a decimal point."},
                                .hooks = {.call = check}};

} // namespace feedhold::rules::argument_without_point
