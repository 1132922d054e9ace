#include "rules/comments/argument_list.h"

#include "base/support/text.h"
#include "findings/rule/dead_blocks.h"
#include "rules/comments/header_call.h"
#include "rules/flow/flow_view.h"

#include <string>

namespace feedhold::rules {
namespace {

/// Reads one remark: `A=WIDTH`, `X, Y = CENTER`, `#18 = RADIUS`, `R: RADIUS`.
class Reader {
public:
  Reader(std::string_view upper, const Dialect &dialect) : text_(upper), dialect_(dialect) {}

  std::set<std::uint32_t> variables() {
    std::set<std::uint32_t> found;
    for (at_ = 1; at_ < text_.size(); ++at_) {
      if (isLetter(text_[at_ - 1]) || isDigit(text_[at_ - 1]))
        continue;
      const bool isNumber = text_[at_] == '#';
      const auto variable = isNumber ? numbered() : lettered();
      if (!variable)
        continue;
      pending_.insert(*variable);
      if (isNumber) // whatever is said of it
        found.insert(*variable);
      skipBlanks();
      if (isNaming())
        found.insert(pending_.begin(), pending_.end());
      if (at_ >= text_.size() || (text_[at_] != ',' && text_[at_] != '/'))
        pending_.clear();
    }
    return found;
  }

private:
  void skipBlanks() {
    while (at_ < text_.size() && isBlank(text_[at_]))
      ++at_;
  }
  /// `=` or `:` with a name behind it: `A=15` is a value.
  bool isNaming() const {
    if (at_ >= text_.size() || (text_[at_] != '=' && text_[at_] != ':'))
      return false;
    const std::size_t name = text_.find_first_not_of(" \t=:", at_);
    return name != std::string_view::npos && (isLetter(text_[name]) || text_[name] == '#');
  }
  std::optional<std::uint32_t> numbered() {
    std::uint32_t number = 0;
    for (++at_; at_ < text_.size() && isDigit(text_[at_]) && number <= kLocalVariables; ++at_)
      number = number * 10 + static_cast<std::uint32_t>(text_[at_] - '0');
    return number > 0 && number <= kLocalVariables ? std::optional(number) : std::nullopt;
  }
  std::optional<std::uint32_t> lettered() {
    const bool isOne =
        isLetter(text_[at_]) && (at_ + 1 >= text_.size() || (!isLetter(text_[at_ + 1]) && !isDigit(text_[at_ + 1])));
    if (!isOne)
      return std::nullopt;
    const char letter = text_[at_++];
    for (std::uint32_t variable = 1; variable <= kLocalVariables; ++variable)
      if (letterOfArgument(dialect_, variable) == letter)
        return variable;
    return std::nullopt;
  }

  std::string_view text_;
  const Dialect &dialect_;
  std::size_t at_ = 1;
  std::set<std::uint32_t> pending_; // `X, Y`: up to the sign behind them
};

} // namespace

std::optional<ArgumentList> argumentListOf(const FileContext &context, ProgramId program) {
  const Program &whole = context.model.programs[program];
  std::optional<ArgumentList> list;
  bool isHead = true;
  for (BlockId block = whole.first; block < whole.last; block = block.next()) {
    isHead = isHead && (block == whole.first || !hasContent(context, block));
    if (!isHead && !list)
      break;
    for (const Comment &comment : context.tree.commentsOf(block)) {
      const auto named = Reader(toUpper(context.text(comment.span)), context.dialect).variables();
      if (named.empty())
        continue;
      if (!list)
        list = ArgumentList{{}, comment.span};
      list->variables.insert(named.begin(), named.end());
    }
  }
  const auto call = headerCallOf(context, program);
  for (std::uint32_t variable = 1; list && call && variable <= kLocalVariables; ++variable)
    if (const auto letter = letterOfArgument(context.dialect, variable); letter && call->letters.contains(*letter))
      list->variables.insert(variable);
  return list;
}

} // namespace feedhold::rules
