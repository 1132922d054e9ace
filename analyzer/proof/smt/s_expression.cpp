#include "proof/smt/s_expression.h"

#include <algorithm>
#include <cctype>

namespace feedhold::smt {
namespace {

constexpr std::size_t kDeepestText = 1000;

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

bool endsAtom(char c) { return isSpace(c) || c == '(' || c == ')' || c == ';' || c == '|'; }

} // namespace

Result<std::vector<SExpression>> readSExpressions(std::string_view text) {
  std::vector<std::vector<SExpression>> open(1);
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (isSpace(c)) {
      ++at;
    } else if (c == ';') {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '(') {
      if (open.size() > kDeepestText)
        return Error{"lists nest too deep"};
      open.emplace_back();
      ++at;
    } else if (c == ')') {
      if (open.size() == 1)
        return Error{"a `)` without its `(`"};
      SExpression list{SExpression::Kind::List, "", std::move(open.back())};
      open.pop_back();
      open.back().push_back(std::move(list));
      ++at;
    } else if (c == '|') {
      std::size_t end = text.find('|', at + 1);
      if (end == std::string_view::npos)
        return Error{"a `|` without its partner"};
      open.back().push_back({SExpression::Kind::Atom, std::string(text.substr(at + 1, end - at - 1)), {}});
      at = end + 1;
    } else {
      std::size_t end = at;
      while (end < text.size() && !endsAtom(text[end]))
        ++end;
      open.back().push_back({SExpression::Kind::Atom, std::string(text.substr(at, end - at)), {}});
      at = end;
    }
  }
  if (open.size() != 1)
    return Error{"a `(` without its `)`"};
  return std::move(open.front());
}

std::string quotedSymbol(std::string_view name) {
  auto simple = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
  const bool startsWithLetter = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  if (startsWithLetter && std::all_of(name.begin(), name.end(), simple))
    return std::string(name);
  std::string quoted(name);
  std::replace_if(
      quoted.begin(), quoted.end(), [](char c) { return c == '|' || c == '\\'; }, '_');
  return "|" + quoted + "|";
}

} // namespace feedhold::smt
