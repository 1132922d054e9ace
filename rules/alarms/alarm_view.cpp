// What a `#3000=` statement says.
#include "rules/alarms/alarm_view.h"

#include "base/support/text.h"

#include <algorithm>

namespace feedhold::rules {

std::optional<RaisedAlarm> raisedAlarm(const Statement &statement, BlockId block, const FileContext &context) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  const auto number = assignment ? variableNumber(context.tree, assignment->target) : std::nullopt;
  if (!number || !raisesAlarm(context.dialect, *number))
    return std::nullopt;
  RaisedAlarm alarm{statement.span, context.tree.expressions[assignment->value].span,
                    literalValue(context.tree, assignment->value), std::nullopt};
  const auto comments = context.tree.commentsOf(block);
  const auto behind =
      std::ranges::find_if(comments, [&](const Comment &comment) { return comment.span.begin >= statement.span.end; });
  if (behind != comments.end())
    alarm.comment = *behind;
  return alarm;
}

std::string messageOf(const Comment &comment, const FileContext &context) {
  const Span inner{comment.span.begin + 1, comment.closed ? comment.span.end - 1 : comment.span.end};
  return std::string(trimmed(context.source.utf8(inner)));
}

} // namespace feedhold::rules
