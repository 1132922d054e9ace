// Names of the control (`#<_metric>`): what they show of the modal state, and what of them is not followed.
#pragma once

#include "meaning/semantics/context.h"

#include <vector>

namespace feedhold::detail {

/// A number as the range of the name allows it.
template <ValueAlgebra R>
typename R::Value withinRange(StepContext<R> &context, NameRange range, const typename R::Value &value) {
  R &interpretation = context.interpretation;
  switch (range) {
  case NameRange::Any: return value;
  case NameRange::NotNegative: return interpretation.function(FunctionKind::Abs, value);
  case NameRange::Flag:
    return interpretation.select(interpretation.compare(Relation::NotEqual, value, context.zero()),
                                 interpretation.number(1), context.zero());
  }
  return value;
}

/// The code of the dialect by ten times its number; null: it is none of a modal group.
template <ValueAlgebra R> const Code *modalCode(const StepContext<R> &context, const PredefinedName &name) {
  const Code *code = findGCode(context.dialect(), static_cast<std::uint16_t>(name.detail));
  return code && context.modes.indexOf(*code) ? code : nullptr;
}

template <ValueAlgebra R> typename R::Truth isCodeInForce(StepContext<R> &context, const Code &code) {
  return context.interpretation.isOneOf(context.state.codes[code.group], CodeMask{1} << *context.modes.indexOf(code));
}

/// What follows such a code is no code to the control: behind G5 the motion code is as before, behind G5.3 there is
/// none (tried on rs274).
inline bool hasOwnNumber(const Code &code) {
  return code.action != CodeAction::OtherCurve && code.action != CodeAction::OtherCycle &&
         code.action != CodeAction::Unmodelled;
}

/// Ten times the number of the code in force in the group of the code, or of its whole part.
template <ValueAlgebra R>
typename R::Value numberInForce(StepContext<R> &context, const PredefinedName &name, const Code &ofGroup) {
  R &interpretation = context.interpretation;
  const auto numberOf = [&](const Code &code) {
    const int tenths = code.tenths;
    return interpretation.number(name.source == NameSource::CodeWhole ? tenths - tenths % 10 : tenths);
  };
  std::vector<const Code *> codes;
  CodeMask all = 0;
  for (const Code *code : context.modes.group(ofGroup.group).codes)
    if (hasOwnNumber(*code)) {
      codes.push_back(code);
      all |= CodeMask{1} << *context.modes.indexOf(*code);
    }
  const auto isAmong = interpretation.isOneOf(context.state.codes[ofGroup.group], all);
  auto value = context.certain(isAmong) && !codes.empty()
                   ? numberOf(*codes.back())
                   : withinRange(context, name.range, interpretation.notFollowed(name.row.first));
  for (const Code *code : codes)
    value = interpretation.select(isCodeInForce(context, *code), numberOf(*code), value);
  return value;
}

} // namespace feedhold::detail
