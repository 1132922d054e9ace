// How rules look at `#3000=n(MESSAGE)`.
#pragma once

#include "findings/rule/rule.h"

#include <optional>
#include <string>

namespace feedhold::rules {

/// A statement that raises an alarm.
struct RaisedAlarm {
  Span span; // the statement
  Span numberSpan;
  std::optional<Decimal> number;  // absent when computed
  std::optional<Comment> comment; // the message: the comment behind the statement
};

/// The alarm that a statement of the block raises; absent for other statements.
std::optional<RaisedAlarm> raisedAlarm(const Statement &statement, BlockId block, const FileContext &context);

/// The message as the control stores it: without the parentheses.
std::string messageOf(const Comment &comment, const FileContext &context);

} // namespace feedhold::rules
